// SPDX-License-Identifier: GPL-3.0-or-later
// Loads that cause no yield after earlier loads.
#include "engine/contact/planned_yield.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace asperity::planned_yield_test {
namespace {

TEST(CarriedLoad, CoversItselfAndWhatIsLighterOrHarder) {
  const CarriedLoad load{2, 0.9};
  EXPECT_TRUE(load.covers(load));
  EXPECT_TRUE(load.covers({1, 0.9}));
  EXPECT_TRUE(load.covers({2, 1}));
  EXPECT_FALSE(load.covers({std::nextafter(2.0, 3.0), 0.9}));
  EXPECT_FALSE(load.covers({2, std::nextafter(0.9, 0.0)}));
}

TEST(CarriedLoad, KeepsNoneThatAnotherCovers) {
  std::vector<CarriedLoad> carried;
  EXPECT_FALSE(covered(carried, {0, 1}));
  carry(carried, {2, 1});
  carry(carried, {1, 1});
  EXPECT_EQ(carried.size(), 1U);
  carry(carried, {1, 0.8});
  EXPECT_EQ(carried.size(), 2U);
  EXPECT_FALSE(covered(carried, {2, 0.8}));
  carry(carried, {3, 0.7});
  ASSERT_EQ(carried.size(), 1U);
  EXPECT_EQ(carried[0].pressure, 3);
  EXPECT_TRUE(covered(carried, {2, 0.8}));
}

}  // namespace
}  // namespace asperity::planned_yield_test
