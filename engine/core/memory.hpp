// SPDX-License-Identifier: GPL-3.0-or-later
// Counted, aligned memory for all engine buffers that grow with the number of cells: calls report their peak,
// runs obey a limit, and tests assert that disabled effects allocate nothing. Thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <utility>
#include <vector>

namespace asperity {

namespace memory {

// Counted bytes of the process.
std::int64_t held();
// Limit of held() in bytes; 0 means none. Beyond it, acquire() throws Error{out_of_memory}.
void set_limit(std::int64_t bytes);
std::int64_t limit();

// Physical memory in bytes; 4 GiB if unknown.
std::int64_t of_machine();

// Whether a request was finally refused since set_limit, even if the error was caught. Callers that free
// memory and retry decide whether a refusal is final.
void note_exceeded() noexcept;
bool exceeded() noexcept;

// 64-byte aligned. Throws Error{out_of_memory} with the requested and held sizes.
void* acquire(std::size_t bytes);
void release(void* pointer, std::size_t bytes) noexcept;

// Counts memory from elsewhere (Lua's heap): adds `change` bytes, or returns false without change beyond the
// limit.
bool account(std::int64_t change) noexcept;

}  // namespace memory

template <class T>
struct Allocator {
  using value_type = T;
  Allocator() = default;
  template <class U>
  Allocator(const Allocator<U>&) noexcept {}
  T* allocate(std::size_t n) {
    if (n > std::numeric_limits<std::size_t>::max() / sizeof(T))
      n = std::numeric_limits<std::size_t>::max() / sizeof(T);
    return static_cast<T*>(memory::acquire(n * sizeof(T)));
  }
  void deallocate(T* p, std::size_t n) noexcept { memory::release(p, n * sizeof(T)); }
  template <class U>
  bool operator==(const Allocator<U>&) const noexcept {
    return true;
  }
};

template <class T>
using Array = std::vector<T, Allocator<T>>;

// New elements are uninitialised: write before reading.
template <class T>
struct UnsetAllocator : Allocator<T> {
  UnsetAllocator() = default;
  template <class U>
  UnsetAllocator(const UnsetAllocator<U>&) noexcept {}
  template <class U>
  struct rebind {
    using other = UnsetAllocator<U>;
  };
  template <class U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }
};
template <class T>
using UnsetArray = std::vector<T, UnsetAllocator<T>>;

}  // namespace asperity
