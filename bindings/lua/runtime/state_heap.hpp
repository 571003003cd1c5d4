// SPDX-License-Identifier: GPL-3.0-or-later
// Memory of one Lua state, under the engine's limit. Small blocks come from one region, reused by later
// states: a case makes several thousand small objects that live as long as its state. The region counts as a
// whole; other blocks come from std::malloc and count by the byte.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "bindings/lua/registry/lua_api.hpp"

namespace asperity::lua {

// Free lists by block size. Not thread-safe.
class SmallBlocks {
 public:
  static constexpr std::size_t step = 16, longest = 512;

  // `region`: aligned to `step`, outlives this; may be null.
  SmallBlocks(std::byte* region, std::size_t bytes) : next_(region), begin_(region), end_(region + bytes) {}

  bool holds(const void* block) const {
    const auto place = [](const void* at) { return reinterpret_cast<std::uintptr_t>(at); };
    return place(block) - place(begin_) < place(end_) - place(begin_);
  }
  static bool same(std::size_t a, std::size_t b) { return class_of(a) == class_of(b); }
  // Null for 0 bytes, beyond `longest`, or without room.
  void* take(std::size_t bytes) noexcept;
  // `bytes` as taken, or fewer.
  void give(void* block, std::size_t bytes) noexcept;

 private:
  struct Free {
    Free* next;
  };
  static std::size_t class_of(std::size_t bytes) { return (bytes + step - 1) / step; }

  std::byte* next_;  // unused from here on
  std::byte *begin_, *end_;
  std::array<Free*, longest / step + 1> free_{};
};

class StateHeap {
 public:
  static constexpr std::size_t region_bytes = std::size_t{128} << 10;

  // Without a region if memory is short.
  StateHeap();
  ~StateHeap();
  StateHeap(const StateHeap&) = delete;
  StateHeap& operator=(const StateHeap&) = delete;

  // Lua's allocator; `heap` is a StateHeap.
  static void* allocate(void* heap, void* block, std::size_t old_size, std::size_t new_size);
  // Null for another program's state.
  static StateHeap* of(lua_State* L);

  lua_State* main = nullptr;  // main thread; null during creation

 private:
  void* change(void* block, std::size_t old_size, std::size_t new_size);
  bool account(void* block, std::size_t old_size, std::size_t new_size, std::size_t uncounted);

  void* const region_;
  SmallBlocks small_;
};

// Limits grids and Lua's heap by counting, libraries by the system.
void limit_memory(std::int64_t bytes);
// Whether a refusal to this thread's states or the engine was final since then, even if the script caught the
// error.
bool memory_limit_met();

// Adds place and traceback to Lua's memory error only.
std::string placed_memory_error(const std::string& message);

}  // namespace asperity::lua
