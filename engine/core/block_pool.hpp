// SPDX-License-Identifier: GPL-3.0-or-later
// Cache of released memory blocks: successive contacts need equal grids, and a fresh page costs a trap and
// zeroing. Limited in bytes; drops the oldest block first. Thread-safe.
#pragma once

#include <cstddef>
#include <deque>
#include <mutex>

namespace asperity::memory {

class BlockPool {
 public:
  explicit BlockPool(std::size_t most_bytes) : most_bytes_(most_bytes) {}
  ~BlockPool() { drop(); }
  BlockPool(const BlockPool&) = delete;
  BlockPool& operator=(const BlockPool&) = delete;

  // std::malloc caches small blocks itself; a very large block would displace all others.
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

}  // namespace asperity::memory
