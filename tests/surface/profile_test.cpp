// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "engine/core/error.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::profile_test {
namespace {

std::string refusal(double spacing, Array<double> heights) {
  return test::refusal([&] { const Profile profile(spacing, std::move(heights)); });
}

TEST(Profile, LengthAndRange) {
  const Profile profile(0.25e-6, {1e-6, -2e-6, 3e-6, 0});
  EXPECT_EQ(profile.size(), 4);
  EXPECT_EQ(profile.length(), 1e-6);
  EXPECT_EQ(profile.spacing(), 0.25e-6);
  EXPECT_EQ(profile.height_range().min, -2e-6);
  EXPECT_EQ(profile.height_range().max, 3e-6);
  EXPECT_FALSE(profile.closed());
  const Profile copy = profile;  // NOLINT: the copy is the point
  EXPECT_EQ(copy.heights().data(), profile.heights().data());
}

TEST(Profile, ClosedOutline) {
  const Profile outline(1e-6, {1, 2, 3}, 0.5e-3);
  EXPECT_TRUE(outline.closed());
  EXPECT_EQ(outline.closed_radius(), 0.5e-3);
  EXPECT_NE(outline.digest(), Profile(1e-6, {1, 2, 3}).digest());
}

TEST(Profile, Refusals) {
  const std::string spacing = "; give a finite length above zero";
  EXPECT_EQ(refusal(0, {1}), "the spacing of a profile is 0 m" + spacing);
  EXPECT_EQ(refusal(-1, {1}), "the spacing of a profile is -1 m" + spacing);
  EXPECT_EQ(refusal(std::numeric_limits<double>::infinity(), {1}),
            "the spacing of a profile is inf m" + spacing);
  EXPECT_EQ(refusal(1, {}), "a profile has no samples; give at least one height");
  EXPECT_EQ(refusal(1, {0, std::nan(""), std::nan("")}),
            "the height of sample 1 is nan; every height must be a finite number of metres");
}

TEST(Profile, DigestSeesSpacingAndHeights) {
  const std::string digest = Profile(1, {1, 2}).digest();
  EXPECT_EQ(Profile(1, {1, 2}).digest(), digest);
  EXPECT_NE(Profile(2, {1, 2}).digest(), digest);
  EXPECT_NE(Profile(1, {1, std::nextafter(2.0, 3.0)}).digest(), digest);
}

TEST(Profile, HolesAreKeptCountedAndRefusedWhereEverySampleIsNeeded) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Profile profile = Profile::with_holes(1e-6, {1e-6, nan, 3e-6, nan});
  EXPECT_EQ(profile.size(), 4);
  EXPECT_EQ(profile.measured(), 2u);
  EXPECT_FALSE(profile.complete());
  EXPECT_EQ(profile.height_range().max, 3e-6);
  EXPECT_THROW(static_cast<void>(profile.heights()), Error);
  EXPECT_EQ(Profile::with_holes(1e-6, {1e-6, 2e-6}).digest(), Profile(1e-6, {1e-6, 2e-6}).digest());
  EXPECT_NE(Profile::with_holes(1e-6, {1e-6, nan}).digest(), Profile::with_holes(1e-6, {nan, 1e-6}).digest());
  EXPECT_THROW(Profile(1e-6, {1e-6, nan}), Error);
  EXPECT_THROW(Profile::with_holes(1e-6, {nan}), Error);
}

}  // namespace
}  // namespace asperity::profile_test
