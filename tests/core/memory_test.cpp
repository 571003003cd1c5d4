// SPDX-License-Identifier: GPL-3.0-or-later
// Counted memory: current, peak of a scope, limit.
#include "engine/core/memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

#include "engine/core/cost.hpp"
#include "engine/core/error.hpp"
#include "engine/core/grid.hpp"

namespace asperity::memory_test {
namespace {

class Memory : public ::testing::Test {
 protected:
  void TearDown() override { memory::set_limit(0); }
  const std::int64_t before = memory::held();
};

TEST_F(Memory, HeldIsWhatLives) {
  {
    const Array<double> array(1000);
    EXPECT_EQ(memory::held() - before, 8000);
    const Field field(10, 20);
    EXPECT_EQ(memory::held() - before, 8000 + 1600);
  }
  EXPECT_EQ(memory::held(), before);
}

TEST_F(Memory, IsAligned) {
  for (const std::size_t n : {1u, 3u, 64u, 1001u}) {
    const Array<char> array(n);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % 64, 0u);
  }
  void* none = memory::acquire(0);
  EXPECT_NE(none, nullptr);
  memory::release(none, 0);
  memory::release(nullptr, 5);
  EXPECT_EQ(memory::held(), before);
}

TEST_F(Memory, LimitIsKeptToTheByte) {
  memory::set_limit(before + 8000);
  EXPECT_EQ(memory::limit(), before + 8000);
  { const Array<double> fits(1000); }
  try {
    const Array<double> too_large(1001);
    ADD_FAILURE() << "the limit was passed";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::out_of_memory);
    EXPECT_EQ(error.hint(), "give fewer `cells`, or raise `--limit-memory`");
    EXPECT_NE(error.sentence().find("of a limit of "), std::string::npos) << error.sentence();
  }
  EXPECT_EQ(memory::held(), before);
}

// Reused blocks are cleared.
TEST_F(Memory, ArraysAreZeroWhoeverHadTheirBlock) {
  constexpr std::size_t count = 40000;
  for (int turn = 0; turn < 3; ++turn) {
    Array<double> field(count);
    for (const double value : field) ASSERT_EQ(value, 0);
    std::fill(field.begin(), field.end(), 7.0);
  }
}

TEST_F(Memory, AbsurdSizesAreRefusedNotWrapped) {
  Array<double> array;
  try {
    array.reserve(array.max_size());
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::out_of_memory);
    EXPECT_EQ(error.sentence().substr(0, 25), "out of memory: requested ");
  }
  EXPECT_THROW(memory::acquire(std::numeric_limits<std::size_t>::max()), Error);
  EXPECT_THROW(Allocator<double>().allocate(std::numeric_limits<std::size_t>::max() / 4), Error);
  EXPECT_EQ(memory::held(), before);
}

TEST_F(Memory, ForeignMemoryFallsUnderTheLimit) {
  memory::set_limit(before + 100);
  EXPECT_TRUE(memory::account(100));
  EXPECT_FALSE(memory::account(1));
  EXPECT_EQ(memory::held() - before, 100);
  EXPECT_TRUE(memory::account(-100));
  EXPECT_EQ(memory::held(), before);
}

TEST_F(Memory, ScopeSeesThePeak) {
  const Array<double> outside(500);
  const CostScope outer;
  {
    const CostScope inner;
    { const Array<double> passing(1000); }
    const Array<double> kept(10);
    EXPECT_EQ(inner.so_far().bytes, 8000);
  }
  { const Array<double> later(100); }
  EXPECT_EQ(outer.so_far().bytes, 8000);
  const CostScope empty;
  EXPECT_EQ(empty.so_far().bytes, 0);
}

TEST(Cost, ACountDoesNotDependOnThoseBeforeIt) {
  const auto counted = [] {
    const CostScope scope;
    for (int k = 0; k < 30; ++k) cost::count_transforms(1.0 / 7);
    return scope.so_far().transforms;
  };
  const double first = counted();
  EXPECT_NEAR(first, 30.0 / 7, 30e-8);
  cost::count_transforms(1e5 / 3);
  EXPECT_EQ(counted(), first);
}

TEST(Cost, AddsUp) {
  Cost sum{1.0, 2.0, 30};
  sum += Cost{0.5, 1.0, 20};
  EXPECT_EQ(sum.seconds, 1.5);
  EXPECT_EQ(sum.transforms, 3.0);
  EXPECT_EQ(sum.bytes, 30);
}

}  // namespace
}  // namespace asperity::memory_test
