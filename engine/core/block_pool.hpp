// SPDX-License-Identifier: GPL-3.0-or-later
// Blocks of memory that were given back, kept for whoever next asks for as many bytes: one contact after the
// other asks for the same grids, and a fresh page costs a trap and its zeroing.
// Holds no more than a fixed number of bytes, the oldest going first. Thread-safe.
#pragma once

#include <cstddef>
#include <deque>
#include <mutex>

namespace asperity::memory {

class BlockPool {
 public:
  // Blocks are of std::malloc's family.
  explicit BlockPool(std::size_t most_bytes) : most_bytes_(most_bytes) {}
  ~BlockPool() { drop(); }
  BlockPool(const BlockPool&) = delete;
  BlockPool& operator=(const BlockPool&) = delete;

  // Worth keeping: small ones are kept by std::malloc, and one great one would put out all others.
  bool takes(std::size_t bytes) const { return bytes >= least_bytes && bytes <= most_bytes_ / 4; }
  // The block of so many bytes that was given last, or null. What is in it is what its last holder left.
  void* take(std::size_t bytes);
  // Takes the block over; false where it is not kept, and the caller still has it.
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
  std::deque<Block> blocks_;  // the oldest first
  std::size_t bytes_ = 0;
};

}  // namespace asperity::memory
