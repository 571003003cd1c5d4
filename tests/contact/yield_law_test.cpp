// SPDX-License-Identifier: GPL-3.0-or-later
// The active limit, and refused laws.
#include "engine/contact/yield_law.hpp"

#include <gtest/gtest.h>

#include "engine/core/error.hpp"

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

TEST(YieldLaw, RefusesWhatIsNotPositive) {
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    YieldLaw law;
    law.cap = bad;
    EXPECT_THROW(check(law, 2, 2), Error);
    law = {};
    law.hardening = bad;
    EXPECT_THROW(check(law, 2, 2), Error);
    law.hardening = 1;
    law.yield = std::make_shared<const Field>(2, 2, bad);
    EXPECT_THROW(check(law, 2, 2), Error);
  }
  YieldLaw law;
  law.yield = std::make_shared<const Field>(2, 2, 1.0);
  EXPECT_THROW(check(law, 2, 2), Error);  // without hardening
  law.hardening = 1;
  EXPECT_NO_THROW(check(law, 2, 2));
  EXPECT_THROW(check(law, 3, 2), Error);
}

}  // namespace
}  // namespace asperity::yield_law_test
