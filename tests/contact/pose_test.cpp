// SPDX-License-Identifier: GPL-3.0-or-later
// How the upper body lies: exact on the lattice, interpolated between, angles that add up.
#include "engine/contact/bodies/pose.hpp"

#include <cmath>
#include <numbers>

#include "tests/contact/contacts.hpp"

namespace asperity::pose_test {
namespace {

using test::random_surface;

constexpr double degree = std::numbers::pi / 180;

Grid square(int n) { return {n, n, 1.0 * n, 1.0 * n}; }

TEST(Pose, BeginsWithTheTurnOfItsLattice) {
  const Pose pose(LatticeIsometry(6, 6).turned(3));
  EXPECT_TRUE(pose.on_lattice());
  EXPECT_NEAR(pose.angle(), -90 * degree, 1e-15);
}

TEST(Pose, QuarterTurnsAreThoseOfTheLattice) {
  const Pose home(LatticeIsometry(5, 5));
  for (int quarters = -5; quarters <= 5; ++quarters) {
    const Pose turned = home.turned(quarters * 90 * degree, square(5));
    EXPECT_TRUE(turned.on_lattice());
    EXPECT_EQ(turned.lattice(), home.lattice().turned(quarters)) << quarters;
  }
}

TEST(Pose, AWholeTurnInAnyNumberOfStepsIsTheIdentity) {
  const Pose home(LatticeIsometry(8, 8));
  for (const int steps : {1, 3, 7, 1000}) {
    Pose pose = home;
    for (int k = 0; k < steps; ++k) pose = pose.turned(2 * std::numbers::pi / steps, square(8));
    EXPECT_TRUE(pose.on_lattice()) << steps;
    EXPECT_EQ(pose.lattice(), home.lattice()) << steps;
  }
}

TEST(Pose, SnapsToTheLatticeWithinANanoradian) {
  const Pose home(LatticeIsometry(8, 8));
  EXPECT_TRUE(home.turned(90 * degree + 9e-10, square(8)).on_lattice());
  EXPECT_FALSE(home.turned(90 * degree + 1.1e-9, square(8)).on_lattice());
}

TEST(Pose, HalfTurnsAloneAreOnTheLatticeOfATileThatIsNotSquare) {
  const Grid oblong{6, 4, 6, 4};
  const Pose home(LatticeIsometry(6, 4));
  EXPECT_TRUE(home.turned(180 * degree, oblong).on_lattice());
  const Pose quarter = home.turned(90 * degree, oblong);
  EXPECT_FALSE(quarter.on_lattice());
  EXPECT_NEAR(std::abs(quarter.rest()), 90 * degree, 1e-15);
  // Square cells, but the other way about the sides differ.
  EXPECT_FALSE(Pose(LatticeIsometry(6, 6)).turned(90 * degree, Grid{6, 6, 6, 3}).on_lattice());
}

TEST(Pose, APlaneTurnsAsAPlane) {
  // Bilinear interpolation is exact for planes: own z = x of the upper body, turned over (x -> -x about
  // the middle) and turned by 30 deg, is −(c x + s y) seen from below.
  const Grid grid = square(9);
  const Surface plane = test::surface_of(grid, [](int i, int) { return i - 4.0; });
  const Pose pose = Pose(LatticeIsometry(9, 9)).turned(30 * degree, grid);
  const Field seen = pose.to_lower(plane.heights(), grid);
  const double c = std::cos(30 * degree), s = std::sin(30 * degree);
  int inside = 0;
  for (int j = 0; j < 9; ++j)
    for (int i = 0; i < 9; ++i) {
      if (std::isnan(seen(i, j))) continue;
      ++inside;
      EXPECT_NEAR(seen(i, j), -(c * (i - 4) + s * (j - 4)), 1e-14);
    }
  EXPECT_GT(inside, 50);
  EXPECT_LT(inside, 81);
  EXPECT_TRUE(std::isnan(seen(0, 0)));
}

TEST(Pose, BackAndForthOnTheLatticeIsBitExact) {
  const Grid grid = square(7);
  const Surface body = random_surface(7, 7, 3, 7, 7);
  const Pose pose(LatticeIsometry(7, 7).turned(1).shifted(2, -3));
  const Field back = pose.to_upper(pose.to_lower(body.heights(), grid), grid);
  EXPECT_TRUE(std::equal(back.values().begin(), back.values().end(), body.heights().values().begin()));
}

TEST(Pose, TheKernelBackIsPositiveAndKeepsVolume) {
  const Grid grid = square(64);
  Field bump(64, 64);
  for (int j = 24; j < 40; ++j)
    for (int i = 20; i < 44; ++i) bump(i, j) = 1 + 0.1 * (i % 3);
  const Pose pose = Pose(LatticeIsometry(64, 64)).turned(23 * degree, grid);
  const Field own = pose.to_upper(bump, grid);
  EXPECT_GE(range(own.values()).min, 0);
  EXPECT_LE(range(own.values()).max, 1.2);
  EXPECT_NEAR(block_sum(own.values()) / block_sum(bump.values()), 1, 0.01);
}

TEST(Pose, ASingleNodeMayTurn) {
  const Grid one{1, 1, 1, 1};
  const Pose pose = Pose(LatticeIsometry(1, 1)).turned(10 * degree, one);
  EXPECT_EQ(pose.to_lower(Field(1, 1, 5.0), one)(0, 0), 5);
}

}  // namespace
}  // namespace asperity::pose_test
