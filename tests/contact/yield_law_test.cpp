// SPDX-License-Identifier: GPL-3.0-or-later
// The active limit, and both laws in cell units.
#include "engine/contact/yield_law.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace asperity::yield_law_test {
namespace {

TEST(YieldLaw, HardeningReplacesTheCap) {
  YieldLaw law;
  EXPECT_FALSE(law.limits());
  law.cap = 1e9;
  EXPECT_TRUE(law.caps() && !law.hardens());
  law.hardening = 5e13;
  EXPECT_TRUE(law.hardens() && !law.caps());
  law.cap = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(law.limits());
  law.yield = std::make_shared<const Field>(2, 2, 1e9);
  EXPECT_TRUE(law.hardens());
}

TEST(PressureCap, ClipsToZeroAndTheCapAndOpensNothing) {
  const PressureCap law{2};
  EXPECT_EQ(law.settle(0, 1.5, 7, 3), 1.5);
  EXPECT_EQ(law.settle(0, 2, 7, 3), 2);
  EXPECT_EQ(law.settle(0, 2.5, 7, 3), 2);
  EXPECT_EQ(law.settle(0, -1, 7, 3), 0);
  EXPECT_FALSE(std::signbit(law.settle(0, -0.0, 7, 3)));
  EXPECT_EQ(PressureCap{}.settle(0, 1e300, 7, 3), 1e300);
  EXPECT_EQ(law.opening(0, 3), 0);
  EXPECT_EQ(law.yielding_slope(), 0);
  EXPECT_EQ(greatest_pressure(law), 2);
}

// Yield pressures 1 and 2 in cell units.
TEST(LinearHardening, OpensInProportionToThePressurePastTheYieldPressure) {
  const std::array<double, 2> yield = {2, 4};
  const LinearHardening law{yield.data(), 9, 0.5, 0.25}, uniform{nullptr, 9, 0.5, 0.25};
  EXPECT_EQ(law.yields_at(0), 1);
  EXPECT_EQ(law.yields_at(1), 2);
  EXPECT_EQ(uniform.yields_at(1), 9);
  EXPECT_EQ(law.opening(1, 4), 0.5);
  EXPECT_EQ(law.opening(1, 2), 0);
  EXPECT_EQ(law.opening(1, 1), 0);
  EXPECT_EQ(law.yielding_slope(), 0.25);
  EXPECT_EQ(greatest_pressure(law), std::numeric_limits<double>::infinity());
}

// Balance of the node by itself: g + w(p) + own compliance · (p - p before) is the gap of the others.
TEST(LinearHardening, SettlesFarPastTheYieldPressureToTheBalanceOfTheNode) {
  const LinearHardening law{nullptr, 2, 1, 0.25};
  const double before = 5, balance = 1, settled = law.settle(0, before, 3, balance);
  EXPECT_NEAR(3 + law.opening(0, settled) + LinearHardening::own_compliance * (settled - before), balance,
              1e-15);
  EXPECT_EQ(law.settle(0, before, 6, balance), 2);    // would unload the node: to the yield pressure
  EXPECT_EQ(law.settle(0, before, 0.5, balance), 5);  // more than half of the excess stays: no overshoot
  EXPECT_EQ(law.settle(0, before, 6, std::numeric_limits<double>::quiet_NaN()), 5);
}

TEST(LinearHardening, SettlesToZeroOrNotAtAllBelowTheYieldPressure) {
  const LinearHardening law{nullptr, 2, 1, 0.25};
  EXPECT_EQ(law.settle(0, 1.5, 9, 1), 1.5);
  EXPECT_EQ(law.settle(0, 2, 9, 1), 2);
  EXPECT_EQ(law.settle(0, -1, 9, 1), 0);
  EXPECT_FALSE(std::signbit(law.settle(0, -0.0, 9, 1)));
}

}  // namespace
}  // namespace asperity::yield_law_test
