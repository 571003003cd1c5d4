// SPDX-License-Identifier: GPL-3.0-or-later
// Counted, aligned memory for all engine buffers that grow with the number of cells: calls report their peak
// and runs obey a limit. Thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
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

// Whether a request was finally refused since set_limit, even if the error was caught. The caller decides
// whether a refusal is final.
void note_exceeded() noexcept;
bool exceeded() noexcept;

// 64-byte aligned. Throws Error{out_of_memory} with the requested and held sizes.
void* acquire(std::size_t bytes);
void release(void* pointer, std::size_t bytes) noexcept;

// Counts memory from elsewhere (Lua's heap): adds `change` bytes, or returns false without change beyond the
// limit.
bool account(std::int64_t change) noexcept;

// Cache of released memory blocks: successive contacts need equal grids, and fresh pages are slow. Limited in
// bytes; drops the oldest block first. Thread-safe.
class BlockPool {
 public:
  explicit BlockPool(std::size_t most_bytes) : most_bytes_(most_bytes) {}
  ~BlockPool() { drop(); }

  // malloc caches small blocks; a very large block would displace all others.
  bool takes(std::size_t bytes) const { return bytes >= least_bytes && bytes <= most_bytes_ / 4; }
  // The last stored block of this size, or null. Undefined content.
  void* take(std::size_t bytes);
  // On false, the block remains the caller's.
  bool give(void* block, std::size_t bytes) noexcept;
  void drop() noexcept;
  std::size_t bytes() const;

 private:
  static constexpr std::size_t least_bytes = std::size_t{16} << 10;
  static constexpr std::size_t most_blocks = 256;

  struct Block {
    void* at;
    std::size_t bytes;
  };
  void drop_oldest() noexcept;

  const std::size_t most_bytes_;
  mutable std::mutex mutex_;
  std::deque<Block> blocks_;  // oldest first
  std::size_t bytes_ = 0;
};

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

// Reusable work spaces for parallel loops, one per concurrent block. Content of the previous use remains.
// Thread-safe.
template <class Scratch>
class ScratchPool {
 public:
  struct Return {
    ScratchPool* pool;
    void operator()(Scratch* scratch) const {
      const std::lock_guard lock(pool->mutex_);
      pool->idle_.emplace_back(scratch);
    }
  };
  using Loan = std::unique_ptr<Scratch, Return>;

  // `make` returns a unique_ptr<Scratch>.
  template <class Make>
  Loan borrow(const Make& make) {
    std::unique_ptr<Scratch> scratch;
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        scratch = std::move(idle_.back());
        idle_.pop_back();
      }
    }
    if (!scratch) scratch = make();
    return Loan(scratch.release(), Return{this});
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Scratch>> idle_;
};

}  // namespace asperity
