// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/block_pool.hpp"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace asperity::memory {

void* BlockPool::take(std::size_t bytes) {
  if (!takes(bytes)) return nullptr;
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(blocks_.rbegin(), blocks_.rend(),
                                  [bytes](const Block& block) { return block.bytes == bytes; });
  if (found == blocks_.rend()) return nullptr;
  void* const block = found->at;
  blocks_.erase(std::next(found).base());
  bytes_ -= bytes;
  return block;
}

bool BlockPool::give(void* block, std::size_t bytes) noexcept {
  if (!takes(bytes)) return false;
  const std::lock_guard lock(mutex_);
  try {
    blocks_.push_back({block, bytes});
  } catch (const std::bad_alloc&) {
    return false;
  }
  bytes_ += bytes;
  while (bytes_ > most_bytes_ || blocks_.size() > most_blocks) drop_oldest();
  return true;
}

void BlockPool::drop() noexcept {
  const std::lock_guard lock(mutex_);
  while (!blocks_.empty()) drop_oldest();
}

std::size_t BlockPool::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

void BlockPool::drop_oldest() noexcept {
  std::free(blocks_.front().at);
  bytes_ -= blocks_.front().bytes;
  blocks_.pop_front();
}

}  // namespace asperity::memory
