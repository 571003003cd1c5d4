// SPDX-License-Identifier: GPL-3.0-or-later
// A limit on transforms stops at a reproducible count.
#include "engine/core/cost.hpp"

#include <gtest/gtest.h>

namespace asperity::cost_test {
namespace {

TEST(TransformLimit, EndsWhatCountsMore) {
  const double before = cost::transforms();
  int counted = 0;
  const auto count = [&](int times) {
    for (int k = 0; k < times; ++k, ++counted) cost::count_transforms(0.5);
  };
  {
    const TransformLimit limit(3);
    EXPECT_NO_THROW(count(6));
    EXPECT_THROW(count(1), TransformLimit::Spent);
    EXPECT_EQ(counted, 6);
  }
  EXPECT_NO_THROW(count(100));
  cost::count_transforms(before - cost::transforms());
}

TEST(TransformLimit, TheInnerOfTwoHoldsUntilItEnds) {
  const double before = cost::transforms();
  const TransformLimit outer(10);
  {
    const TransformLimit inner(1);
    EXPECT_THROW(cost::count_transforms(2), TransformLimit::Spent);
  }
  EXPECT_NO_THROW(cost::count_transforms(5));
  EXPECT_THROW(cost::count_transforms(5), TransformLimit::Spent);
  cost::count_transforms(before - cost::transforms());
}

}  // namespace
}  // namespace asperity::cost_test
