// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/memory.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <thread>
#include <vector>

namespace asperity::memory::block_pool_test {
namespace {

constexpr std::size_t kibibyte = 1024, page = 64 * kibibyte;

void* block(std::size_t bytes) { return std::aligned_alloc(64, bytes); }

TEST(BlockPool, GiveBackTheLastOfTheSameSize) {
  BlockPool kept(1024 * kibibyte);
  void* const first = block(page);
  void* const second = block(page);
  void* const other = block(2 * page);
  for (void* one : {first, second}) ASSERT_TRUE(kept.give(one, page));
  ASSERT_TRUE(kept.give(other, 2 * page));
  EXPECT_EQ(kept.bytes(), 4 * page);
  EXPECT_EQ(kept.take(page), second);
  EXPECT_EQ(kept.take(page), first);
  EXPECT_EQ(kept.take(page), nullptr);
  EXPECT_EQ(kept.take(3 * page), nullptr);
  EXPECT_EQ(kept.bytes(), 2 * page);
  std::free(first);
  std::free(second);
}

TEST(BlockPool, HoldNoMoreThanTheyMayAndTheNewest) {
  BlockPool kept(8 * page);
  std::vector<void*> all;
  for (int k = 0; k < 20; ++k) {
    all.push_back(block(page));
    ASSERT_TRUE(kept.give(all.back(), page));
    EXPECT_LE(kept.bytes(), 8 * page);
  }
  EXPECT_EQ(kept.bytes(), 8 * page);
  for (std::size_t k = 20; k-- > 12;) {
    void* const taken = kept.take(page);
    EXPECT_EQ(taken, all[k]);
    std::free(taken);
  }
  EXPECT_EQ(kept.take(page), nullptr);
}

TEST(BlockPool, LeaveSmallAndGreatOnesAlone) {
  BlockPool kept(8 * page), none(0);
  void* const small = block(kibibyte);
  void* const great = block(3 * page);
  EXPECT_FALSE(kept.give(small, kibibyte));
  EXPECT_FALSE(kept.give(great, 3 * page));
  EXPECT_FALSE(none.give(great, 3 * page));
  EXPECT_EQ(none.take(3 * page), nullptr);
  std::free(small);
  std::free(great);
}

TEST(BlockPool, AreDroppedWhenMemoryIsWanted) {
  BlockPool kept(8 * page);
  ASSERT_TRUE(kept.give(block(page), page));
  kept.drop();
  EXPECT_EQ(kept.bytes(), 0U);
  EXPECT_EQ(kept.take(page), nullptr);
}

// No block has two holders.
TEST(BlockPool, ServeManyThreads) {
  BlockPool kept(8 * page);
  std::vector<int> torn(4, 0);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&kept, &torn, t] {
      for (int k = 0; k < 500; ++k) {
        void* mine = kept.take(page);
        if (mine == nullptr) mine = block(page);
        std::memset(mine, t, page);
        const auto* const bytes = static_cast<const unsigned char*>(mine);
        for (std::size_t i = 0; i < page; i += kibibyte) torn[static_cast<std::size_t>(t)] += bytes[i] != t;
        if (!kept.give(mine, page)) std::free(mine);
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const int count : torn) EXPECT_EQ(count, 0);
}

}  // namespace
}  // namespace asperity::memory::block_pool_test
