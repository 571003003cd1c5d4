// SPDX-License-Identifier: GPL-3.0-or-later
// The projection on bounds and load: the load to a few ulps, the bounds to the bit, and the loads that
// some nodes alone cannot carry.
#include "engine/contact/elasticity/half_space/solver/load_projection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "engine/core/grid.hpp"

namespace asperity::load_projection_test {
namespace {

std::vector<double> wavy(std::size_t n) {
  std::vector<double> y(n);
  for (std::size_t k = 0; k < n; ++k) y[k] = std::sin(.7 * static_cast<double>(k)) - .4;
  return y;
}

TEST(LoadProjection, CarriesTheLoadAndShiftsTheInteriorAlike) {
  const std::vector<double> y = wavy(1000);
  for (const double upper : {.3, 1.0, std::numeric_limits<double>::infinity()})
    for (const double load : {1e-12, 1.0, 250.0, 299.9999}) {
      std::vector<double> p(y.size());
      ASSERT_TRUE(project_to_load(y, {}, upper, load, p));
      EXPECT_NEAR(block_sum(p), load, 1e-14 * load) << upper;
      double shift = std::numeric_limits<double>::quiet_NaN();
      for (std::size_t k = 0; k < p.size(); ++k) {
        ASSERT_TRUE(p[k] >= 0 && p[k] <= upper);
        if (p[k] > 0 && p[k] < upper) {
          if (std::isnan(shift)) shift = p[k] - y[k];
          EXPECT_NEAR(p[k] - y[k], shift, 1e-15);
        }
      }
    }
}

TEST(LoadProjection, LeavesUnmarkedNodesClippedOnly) {
  const std::vector<double> y = wavy(100);
  std::vector<std::uint8_t> where(100);
  for (std::size_t k = 0; k < 50; ++k) where[k] = 1;
  std::vector<double> p(100);
  ASSERT_TRUE(project_to_load(y, where, .5, 20, p));
  EXPECT_NEAR(block_sum(p), 20, 1e-13);
  for (std::size_t k = 50; k < 100; ++k) EXPECT_EQ(p[k], std::min(std::max(y[k], 0.0), .5));
}

TEST(LoadProjection, RefusesWhatTheMarkedNodesCannotCarry) {
  const std::vector<double> y = wavy(100);
  std::vector<std::uint8_t> where(100);
  std::vector<double> p(100, 7.0);
  EXPECT_FALSE(project_to_load(y, where, .5, 20, p));  // none marked
  where[3] = 1;
  EXPECT_FALSE(project_to_load(y, where, .5, 49, p));
  EXPECT_FALSE(project_to_load(y, where, .5, 1e-3, p));
  for (const double value : p) EXPECT_EQ(value, 7.0);
}

TEST(LoadProjection, ReachesBothEnds) {
  const std::vector<double> y = wavy(64);
  std::vector<double> p(64);
  ASSERT_TRUE(project_to_load(y, {}, .25, 16, p));
  for (const double value : p) EXPECT_EQ(value, .25);
  ASSERT_TRUE(project_to_load(y, {}, .25, std::nextafter(16.0, 0.0), p));
  EXPECT_NEAR(block_sum(p), 16, 1e-13);
  ASSERT_TRUE(project_to_load(y, {}, .25, 1e-300, p));
  EXPECT_NEAR(block_sum(p) / 1e-300, 1, 1e-12);
}

}  // namespace
}  // namespace asperity::load_projection_test
