// SPDX-License-Identifier: GPL-3.0-or-later
// Counted, aligned memory for grids and tables. Every buffer of the engine that grows with the
// number of cells comes from here, so that a call can state its peak, a run can be held to a limit
// before the machine is, and a test can assert that an effect that is off allocated nothing.
// Thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <utility>
#include <vector>

namespace asperity {

namespace memory {

// Bytes now held through this file by the whole process.
std::int64_t held();
// The limit on held() in bytes; 0 means none. Exceeding it throws Error{out_of_memory}.
void set_limit(std::int64_t bytes);
std::int64_t limit();

// Bytes of memory that the machine has; 4 GiB where the system does not say.
std::int64_t of_machine();

// Whether a request was refused for good since the limit was set, even if the error was caught. Whoever
// frees something and asks again decides when a refusal is final.
void note_exceeded() noexcept;
bool exceeded() noexcept;

// 64-byte aligned. Throws Error{out_of_memory} naming the size asked for and what is held.
void* acquire(std::size_t bytes);
void release(void* pointer, std::size_t bytes) noexcept;

// For memory that comes from elsewhere (Lua's heap) but falls under the same limit: moves the
// count by `change` bytes; returns false, changing nothing, if the limit would be exceeded.
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

// A std::vector whose storage is counted.
template <class T>
using Array = std::vector<T, Allocator<T>>;

// The same for what is written before it is read: new values are whatever the memory held.
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
