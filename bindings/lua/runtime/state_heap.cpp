// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/runtime/state_heap.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <optional>
#include <utility>

#include "engine/core/memory.hpp"
#include "engine/core/sanitizers.hpp"

namespace asperity::lua {

namespace {

// A library's uncounted heap still ends in bad_alloc.
void limit_address_space(std::int64_t bytes) {
  if (sanitized) return;
  constexpr std::int64_t headroom = std::int64_t{512} << 20;  // code, stacks, libraries
  rlimit limit{};
  if (::getrlimit(RLIMIT_DATA, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, static_cast<rlim_t>(bytes + headroom));
  ::setrlimit(RLIMIT_DATA, &limit);
}
// This thread's last refused request. Lua collects and retries; the next request shows whether the refusal
// was final.
thread_local std::optional<std::pair<void*, std::size_t>> refused;

// The script's place: Lua raises its memory error after unwinding the stack. No allocation.
struct RefusalPlace {
  char line[96] = "";     // "script.lua:12: "
  char trace[1024] = "";  // "\n\tscript.lua:12: in main chunk" ...
};
thread_local RefusalPlace refusal_place;

void note_refusal_place(lua_State* L) {
  RefusalPlace& place = refusal_place;
  std::size_t used = 0;
  lua_Debug frame;
  constexpr int deepest = 16;
  for (int level = 0; level < deepest && lua_getstack(L, level, &frame) != 0; ++level) {
    lua_getinfo(L, "Sl", &frame);
    if (frame.currentline <= 0) continue;
    if (place.line[0] == '\0')
      std::snprintf(place.line, sizeof place.line, "%s:%d: ", frame.short_src, frame.currentline);
    const bool main = frame.what[0] == 'm';
    const int wrote =
        main ? std::snprintf(place.trace + used, sizeof place.trace - used, "\n\t%s:%d: in main chunk",
                             frame.short_src, frame.currentline)
             : std::snprintf(place.trace + used, sizeof place.trace - used, "\n\t%s:%d: in function <%s:%d>",
                             frame.short_src, frame.currentline, frame.short_src, frame.linedefined);
    if (wrote < 0 || static_cast<std::size_t>(wrote) >= sizeof place.trace - used) break;
    used += static_cast<std::size_t>(wrote);
  }
}

// Whether a request may move a thread's stack (at most about a million 16-byte values), whose frames are then
// unreadable.
bool may_move_a_stack(const void* block, std::size_t old_size, std::size_t new_size) {
  constexpr std::size_t slot = 16, biggest = 1'100'000 * slot;
  return block != nullptr && old_size % slot == 0 && new_size % slot == 0 && new_size <= biggest;
}

void note_refusal(lua_State* main, void* block, std::size_t old_size, std::size_t new_size) {
  if (refused) memory::note_exceeded();
  refused = {block, new_size};
  refusal_place = {};
  if (main != nullptr && !may_move_a_stack(block, old_size, new_size)) note_refusal_place(main);
}

// If a granted growth differs from the refused request, the refusal was final.
void note_grant(void* block, std::size_t new_size) {
  if (!refused) return;
  if (*refused != std::pair(block, new_size)) memory::note_exceeded();
  refused.reset();
}

// Regions of closed states; unused under a sanitizer, which must see every block. Never destroyed: a state
// may be closed last.
memory::BlockPool& regions() {
  static memory::BlockPool& pool = *new memory::BlockPool(std::size_t{8} << 20);
  return pool;
}

void* take_region() {
  constexpr auto bytes = static_cast<std::int64_t>(StateHeap::region_bytes);
  if (sanitized || !memory::account(bytes)) return nullptr;
  void* region = regions().take(StateHeap::region_bytes);
  if (region == nullptr) region = std::malloc(StateHeap::region_bytes);
  if (region == nullptr) memory::account(-bytes);
  return region;
}

}  // namespace

void* SmallBlocks::take(std::size_t bytes) noexcept {
  if (bytes == 0 || bytes > longest) return nullptr;
  const std::size_t k = class_of(bytes);
  if (free_[k] != nullptr) return std::exchange(free_[k], free_[k]->next);
  if (static_cast<std::size_t>(end_ - next_) < k * step) return nullptr;
  return std::exchange(next_, next_ + k * step);
}

void SmallBlocks::give(void* block, std::size_t bytes) noexcept {
  if (bytes == 0) return;
  Free*& first = free_[class_of(bytes)];
  first = new (block) Free{first};
}

StateHeap::StateHeap()
    : region_(take_region()),
      small_(static_cast<std::byte*>(region_), region_ == nullptr ? 0 : region_bytes) {}

StateHeap::~StateHeap() {
  if (region_ == nullptr) return;
  if (!regions().give(region_, region_bytes)) std::free(region_);
  memory::account(-static_cast<std::int64_t>(region_bytes));
}

void* StateHeap::allocate(void* heap, void* block, std::size_t old_size, std::size_t new_size) {
  auto& self = *static_cast<StateHeap*>(heap);
  const std::size_t held = block == nullptr ? 0 : old_size;  // else old_size is a type code
  if (new_size > 0) return self.change(block, held, new_size);
  if (self.small_.holds(block)) {
    self.small_.give(block, held);
  } else {
    std::free(block);
    memory::account(-static_cast<std::int64_t>(held));
  }
  return nullptr;
}

StateHeap* StateHeap::of(lua_State* L) {
  void* heap = nullptr;
  return lua_getallocf(L, &heap) == allocate ? static_cast<StateHeap*>(heap) : nullptr;
}

// The region counts `uncounted` bytes of the old block.
bool StateHeap::account(void* block, std::size_t old_size, std::size_t new_size, std::size_t uncounted) {
  const auto more = static_cast<std::int64_t>(new_size) - static_cast<std::int64_t>(old_size - uncounted);
  if (memory::account(more)) return true;
  note_refusal(main, block, old_size, new_size);
  return false;
}

void* StateHeap::change(void* block, std::size_t old_size, std::size_t new_size) {
  const bool small = small_.holds(block), grows = new_size > old_size;
  if (!small && block != nullptr) {
    if (!account(block, old_size, new_size, 0)) return nullptr;
    if (grows) note_grant(block, new_size);
    void* moved = std::realloc(block, new_size);
    if (moved == nullptr)
      memory::account(static_cast<std::int64_t>(old_size) - static_cast<std::int64_t>(new_size));
    return moved;
  }
  if (small && SmallBlocks::same(old_size, new_size)) {
    if (grows) note_grant(block, new_size);
    return block;
  }
  void* fresh = small_.take(new_size);
  if (fresh != nullptr) {
    if (grows) note_grant(block, new_size);
  } else {
    if (!grows) return block;  // always possible
    if (!account(block, old_size, new_size, old_size)) return nullptr;
    note_grant(block, new_size);
    fresh = std::malloc(new_size);
    if (fresh == nullptr) {
      memory::account(-static_cast<std::int64_t>(new_size));
      return nullptr;
    }
  }
  if (block != nullptr) {
    std::memcpy(fresh, block, std::min(old_size, new_size));
    small_.give(block, old_size);
  }
  return fresh;
}

void limit_memory(std::int64_t bytes) {
  memory::set_limit(bytes);
  limit_address_space(bytes);
}

bool memory_limit_met() { return memory::exceeded() || refused.has_value(); }

std::string placed_memory_error(const std::string& message) {
  const RefusalPlace& place = refusal_place;
  if (message != "not enough memory" || place.line[0] == '\0') return message;
  return place.line + message + "\nstack traceback:" + place.trace;
}

}  // namespace asperity::lua
