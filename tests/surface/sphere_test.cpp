// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/generators/sphere.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/core/error.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::sphere_test {
namespace {

std::string refusal(const SphereOptions& options) {
  return test::refusal([&] { sphere_surface(options); });
}

TEST(Sphere, ApexStandsOnTheMiddleNodeAtHeightZero) {
  for (const int nx : {1, 2, 7, 16})
    for (const int ny : {1, 5, 8}) {
      const Surface surface = sphere_surface({{nx, ny, 1e-3, 1e-3}, 1e-2, SphereShape::sphere});
      EXPECT_EQ(surface.height(nx / 2, ny / 2), 0.0);
      EXPECT_EQ(surface.height_range().max, 0.0);
      EXPECT_FALSE(surface.traits().periodic);
    }
}

TEST(Sphere, Heights) {
  // A scaled 3-4-5 triangle: 3 cells off the apex, 4 above the centre.
  const Grid grid{8, 8, 8, 8};
  const Surface cap = sphere_surface({grid, 5 * std::sqrt(2.0), SphereShape::sphere});
  EXPECT_NEAR(cap.height(0, 4), std::sqrt(50.0 - 16) - std::sqrt(50.0), 1e-14);
  EXPECT_NEAR(cap.height(1, 0), 5 - 5 * std::sqrt(2.0), 1e-14);
  const Surface paraboloid = sphere_surface({grid, 5, SphereShape::paraboloid});
  EXPECT_DOUBLE_EQ(paraboloid.height(7, 4), -0.9);
  EXPECT_NEAR(paraboloid.height(1, 0), -2.5, 1e-15);
}

TEST(Sphere, KeepsItsDigitsNearTheApexOfALargeSphere) {
  const Surface cap = sphere_surface({{4, 4, 4e-6, 4e-6}, 1e3, SphereShape::sphere});
  EXPECT_NEAR(cap.height(3, 2) / -5e-16, 1, 1e-14);
}

TEST(Sphere, CellsNeedNotBeSquare) {
  const Surface surface = sphere_surface({{4, 8, 4, 2}, 10, SphereShape::paraboloid});
  EXPECT_DOUBLE_EQ(surface.height(3, 4), -1.0 / 20);
  EXPECT_DOUBLE_EQ(surface.height(2, 5), -0.25 * 0.25 / 20);
}

TEST(Sphere, MustReachTheCorner) {
  const Grid grid{8, 8, 8e-6, 8e-6};  // 4√2 cells from the apex
  EXPECT_EQ(refusal({grid, 5e-6, SphereShape::sphere}),
            "`radius` is 5 um, but the corner of the grid is 5.657 um from the apex; give a larger radius, a "
            "smaller "
            "`size`, or shape = \"paraboloid\"");
  EXPECT_EQ(refusal({grid, 5e-6, SphereShape::paraboloid}), "accepted");
  const Surface half = sphere_surface({grid, 4e-6 * std::sqrt(2.0), SphereShape::sphere});
  EXPECT_NEAR(half.height(0, 0), -4e-6 * std::sqrt(2.0), 1e-6 * 1e-7);
}

TEST(Sphere, RadiusMustBePositive) {
  const std::string hint = "; give a finite length above zero";
  EXPECT_EQ(refusal({{4, 4, 1, 1}, 0, SphereShape::sphere}), "`radius` is 0 m" + hint);
  EXPECT_EQ(refusal({{4, 4, 1, 1}, -1, SphereShape::paraboloid}), "`radius` is -1 m" + hint);
  EXPECT_EQ(refusal({{4, 4, 1, 1}, std::nan(""), SphereShape::paraboloid}), "`radius` is nan m" + hint);
}

}  // namespace
}  // namespace asperity::sphere_test
