// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "engine/core/error.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::surface_test {
namespace {

const Grid grid{3, 2, 3e-6, 2e-6};

Field ramp() {
  Field field(3, 2);
  for (std::size_t k = 0; k < field.size(); ++k) field[k] = 1e-9 * static_cast<double>(k);
  return field;
}

using test::refusal;

TEST(Surface, IndexOrder) {
  const Surface surface(grid, ramp());
  EXPECT_EQ(surface.height(0, 0), 0.0);
  EXPECT_EQ(surface.height(2, 0), 2e-9);  // i along x first
  EXPECT_EQ(surface.height(0, 1), 3 * 1e-9);
  EXPECT_EQ(surface.height_range().max, 5 * 1e-9);
  EXPECT_EQ(surface.peak_to_valley(), 5 * 1e-9);
  EXPECT_EQ(surface.grid(), grid);
  EXPECT_FALSE(surface.traits().periodic);
  EXPECT_FALSE(surface.traits().aliased_share.has_value());
}

TEST(Surface, ThereIsNoNodeOutside) {
  const Surface surface(grid, ramp());
  const std::string hint = "; i runs from 0 to 2, j from 0 to 1";
  const auto ask = [&](double i, double j) {
    return refusal([&] { surface.height(i, j); }, ErrorCode::bad_value);
  };
  EXPECT_EQ(ask(3, 0), "there is no node (3, 0)" + hint);
  EXPECT_EQ(ask(0, 2), "there is no node (0, 2)" + hint);
  EXPECT_EQ(ask(-1, 0), "there is no node (-1, 0)" + hint);
  EXPECT_EQ(ask(0.5, 0), "there is no node (0.5, 0)" + hint);
  EXPECT_EQ(ask(std::nan(""), 0), "there is no node (nan, 0)" + hint);
}

TEST(Surface, FirstBadHeightIsNamed) {
  Field field = ramp();
  field(2, 1) = std::numeric_limits<double>::infinity();
  field(1, 1) = std::nan("");
  EXPECT_EQ(refusal([&] { Surface(grid, field); }, ErrorCode::bad_value),
            "the height at node (1, 1) is nan; every height must be a finite number of metres");
  field(1, 1) = 0;
  EXPECT_EQ(refusal([&] { Surface(grid, field); }, ErrorCode::bad_value),
            "the height at node (2, 1) is inf; every height must be a finite number of metres");
}

TEST(Surface, HeightsMustFitTheGrid) {
  EXPECT_EQ(refusal([&] { Surface(grid, Field(2, 3)); }, ErrorCode::internal),
            "a surface of 3 x 2 cells was given 2 x 3 heights");
}

TEST(Surface, CopiesShareHeights) {
  const Surface surface(grid, ramp());
  const Surface copy = surface;  // NOLINT: the copy is the point
  EXPECT_EQ(copy.heights().data(), surface.heights().data());
  const Surface quartz = surface.with_material(named_material("quartz"));
  EXPECT_EQ(quartz.heights().data(), surface.heights().data());
  EXPECT_EQ(quartz.material()->name, "quartz");
  EXPECT_FALSE(surface.material().has_value());
  EXPECT_EQ(quartz.digest(), surface.digest());
}

TEST(Surface, MaterialKeepsTheOtherTraits) {
  SurfaceTraits traits;
  traits.periodic = true;
  traits.aliased_share = 0.25;
  const Surface surface = Surface(grid, ramp(), traits).with_material(rigid_material());
  EXPECT_TRUE(surface.traits().periodic);
  EXPECT_EQ(surface.traits().aliased_share, 0.25);
}

TEST(Surface, DigestSeesHeightsAndGrid) {
  const std::string digest = Surface(grid, ramp()).digest();
  EXPECT_EQ(Surface(grid, ramp()).digest(), digest);
  Field field = ramp();
  field(2, 1) = std::nextafter(field(2, 1), 1.0);
  EXPECT_NE(Surface(grid, field).digest(), digest);
  EXPECT_NE(Surface(Grid{3, 2, 3e-6, 2.5e-6}, ramp()).digest(), digest);
  Field other(2, 3);
  for (std::size_t k = 0; k < other.size(); ++k) other[k] = ramp()[k];
  EXPECT_NE(Surface(Grid{2, 3, 3e-6, 2e-6}, other).digest(), digest);
}

TEST(Surface, HolesAreKeptAndCounted) {
  Field field = ramp();
  field(2, 1) = -std::numeric_limits<double>::quiet_NaN();
  const Surface surface = Surface::with_holes(grid, field);
  EXPECT_EQ(surface.measured(), 5u);
  EXPECT_FALSE(surface.complete());
  EXPECT_TRUE(std::isnan(surface.measured_heights()(2, 1)));
  EXPECT_TRUE(std::isnan(surface.height(2, 1)));
  EXPECT_EQ(surface.height(1, 1), ramp()(1, 1));
  EXPECT_EQ(surface.height_range().max, ramp()(1, 1));
  // The digest ignores the sign of a NaN.
  Field other = field;
  other(2, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Surface::with_holes(grid, other).digest(), surface.digest());
  other(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(Surface::with_holes(grid, other).digest(), surface.digest());
}

TEST(Surface, WithoutHolesIsTheSameSurfaceMadeEitherWay) {
  const Surface surface = Surface::with_holes(grid, ramp());
  EXPECT_TRUE(surface.complete());
  EXPECT_EQ(surface.measured(), 6u);
  EXPECT_EQ(surface.digest(), Surface(grid, ramp()).digest());
  EXPECT_EQ(&surface.heights(), &surface.measured_heights());
}

TEST(Surface, WhatNeedsEveryPointRefusesHoles) {
  Field field = ramp();
  field(1, 0) = field(0, 1) = std::numeric_limits<double>::quiet_NaN();
  const Surface surface = Surface::with_holes(grid, field);
  try {
    surface.heights();
    FAIL() << "a surface with holes gave all its heights";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_value);
    EXPECT_EQ(error.sentence(),
              "2 of the 6 points of the surface were not measured, the first at node (1, 0), and this needs "
              "every point");
  }
}

TEST(Surface, HolesAreNoNumberAndNotAllThereIs) {
  Field field = ramp();
  field(1, 0) = std::numeric_limits<double>::infinity();
  EXPECT_THROW(Surface::with_holes(grid, field), Error);
  EXPECT_THROW(Surface::with_holes(grid, Field(3, 2, std::numeric_limits<double>::quiet_NaN())), Error);
}

TEST(Surface, OfOneNode) {
  const Surface surface(Grid{1, 1, 1, 1}, Field(1, 1, -3.0));
  EXPECT_EQ(surface.height_range().min, -3.0);
  EXPECT_EQ(surface.peak_to_valley(), 0.0);
}

}  // namespace
}  // namespace asperity::surface_test
