// SPDX-License-Identifier: GPL-3.0-or-later
// Memory of one Lua state, under the same limit as the engine's grids. What is small comes out of one region
// that is kept for the next state: an ensemble makes a state a case, of several thousand objects that live as
// long as it does. The region counts as held as a whole while the state lives; what does not fit into it, and
// what is large, comes from std::malloc and is counted by the byte.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "bindings/lua/registry/lua_api.hpp"

namespace asperity::lua {

// Blocks of one region by their size: a block that is given back serves the next request of its class. Not
// thread-safe.
class SmallBlocks {
 public:
  static constexpr std::size_t step = 16, longest = 512;

  // Of `bytes` bytes from `region` on, which is aligned to a step and outlives this; null: of no region.
  SmallBlocks(std::byte* region, std::size_t bytes) : next_(region), begin_(region), end_(region + bytes) {}

  bool holds(const void* block) const {
    const auto place = [](const void* at) { return reinterpret_cast<std::uintptr_t>(at); };
    return place(block) - place(begin_) < place(end_) - place(begin_);
  }
  // Whether blocks of the one size and of the other are the same.
  static bool same(std::size_t a, std::size_t b) { return class_of(a) == class_of(b); }
  // Null where there is no room, or the request is of none or of more than the longest bytes.
  void* take(std::size_t bytes) noexcept;
  // A block of this region, of so many bytes or fewer than it was taken with.
  void give(void* block, std::size_t bytes) noexcept;

 private:
  struct Free {
    Free* next;
  };
  static std::size_t class_of(std::size_t bytes) { return (bytes + step - 1) / step; }

  std::byte* next_;  // nothing was taken yet from here on
  std::byte *begin_, *end_;
  std::array<Free*, longest / step + 1> free_{};
};

class StateHeap {
 public:
  static constexpr std::size_t region_bytes = std::size_t{128} << 10;

  // Does without a region where there is no room for it.
  StateHeap();
  ~StateHeap();
  StateHeap(const StateHeap&) = delete;
  StateHeap& operator=(const StateHeap&) = delete;

  // Lua's allocator; `heap` is a StateHeap.
  static void* allocate(void* heap, void* block, std::size_t old_size, std::size_t new_size);
  // The heap that a state takes its memory from; null if it is another program's.
  static StateHeap* of(lua_State* L);

  lua_State* main = nullptr;  // the state's main thread; null while it is being made

 private:
  void* change(void* block, std::size_t old_size, std::size_t new_size);
  bool account(void* block, std::size_t old_size, std::size_t new_size, std::size_t uncounted);

  void* const region_;
  SmallBlocks small_;
};

// Limits grids and Lua's heap by counting, libraries by the system.
void limit_memory(std::int64_t bytes);

// Whether a request for memory of this thread's states, or of the engine, was refused for good since the
// limit was set, even if the script caught the error.
bool memory_limit_met();

// Lua's own error of memory with the line that was running when memory was last refused and a traceback;
// any other message as it is.
std::string placed_memory_error(const std::string& message);

}  // namespace asperity::lua
