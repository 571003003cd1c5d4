// SPDX-License-Identifier: GPL-3.0-or-later
// The pose of the upper body: exact on the lattice, interpolated between nodes, additive angles.
#include "engine/contact/bodies/pose.hpp"

#include <cmath>
#include <cstring>
#include <numbers>
#include <set>

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
  // A quarter turn exchanges unequal sides.
  EXPECT_FALSE(Pose(LatticeIsometry(6, 6)).turned(90 * degree, Grid{6, 6, 6, 3}).on_lattice());
}

TEST(Pose, APlaneTurnsAsAPlane) {
  // Bilinear interpolation is exact for planes: z = x, turned over (x -> -x about the middle) and turned by
  // 30 deg, is −(c x + s y) seen from below.
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

using Node = LatticeIsometry::Node;
using test::error_of;

TEST(LatticeIsometry, TurnsTheUpperBodyOverAboutY) {
  const LatticeIsometry over(5, 3);
  EXPECT_EQ(over.to_lower(Node{0, 0}), (Node{4, 0}));
  EXPECT_EQ(over.to_lower(Node{4, 2}), (Node{0, 2}));
  EXPECT_EQ(over.to_upper(Node{1, 1}), (Node{3, 1}));
}

TEST(LatticeIsometry, QuarterTurnIsCounterClockwiseFromAbove) {
  const LatticeIsometry over(5, 5), turned = over.turned(1);
  // A quarter turn: +x to +y, +y to -x.
  EXPECT_EQ(turned.to_lower(over.to_upper(Node{4, 2})), (Node{2, 4}));
  EXPECT_EQ(turned.to_lower(over.to_upper(Node{2, 4})), (Node{0, 2}));
  EXPECT_EQ(turned.quarters(), 1);
}

TEST(LatticeIsometry, ShiftMovesTheUpperBodyAndWraps) {
  const LatticeIsometry over(5, 3), shifted = over.shifted(2, -1);
  EXPECT_EQ(shifted.to_lower(over.to_upper(Node{1, 1})), (Node{3, 0}));
  EXPECT_EQ(shifted.to_lower(over.to_upper(Node{4, 0})), (Node{1, 2}));
  EXPECT_EQ(shifted.shifted(-2, 1), over);
  EXPECT_EQ(over.shifted(5 * 1000000, -3 * 1000000), over);
}

TEST(LatticeIsometry, FieldThroughThereAndBackIsBitIdentical) {
  for (const auto& [nx, ny] : {std::pair{7, 7}, {8, 8}, {1, 1}, {6, 11}, {1, 9}}) {
    for (int quarters = 0; quarters < 4; ++quarters) {
      if (nx != ny && quarters % 2 != 0) continue;
      const LatticeIsometry isometry = LatticeIsometry(nx, ny).turned(quarters).shifted(3, 5);
      const Field own = test::random_surface(nx, ny, 3).heights();
      const Field back = isometry.to_upper(isometry.to_lower(own));
      EXPECT_EQ(std::memcmp(own.data(), back.data(), own.size() * sizeof(double)), 0);
      std::set<std::pair<int, int>> images;
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
          const Node node = isometry.to_lower(Node{i, j});
          images.insert({node.i, node.j});
          EXPECT_EQ(isometry.to_upper(node), (Node{i, j}));
        }
      EXPECT_EQ(images.size(), own.size());
    }
  }
}

TEST(LatticeIsometry, TurningComposesWithWhatCameBefore) {
  const LatticeIsometry start = LatticeIsometry(7, 7).turned(1).shifted(2, 5);
  for (int quarters = -5; quarters <= 5; ++quarters) {
    const LatticeIsometry after = start.turned(quarters);
    for (int j = 0; j < 7; ++j)
      for (int i = 0; i < 7; ++i) {
        Node node = start.to_lower(Node{i, j});
        for (int k = 0; k < ((quarters % 4) + 4) % 4; ++k) node = Node{6 - node.j, node.i};
        EXPECT_EQ(after.to_lower(Node{i, j}), node) << quarters;
      }
  }
  EXPECT_EQ(start.turned(1).turned(1).turned(1).turned(1), start);
  EXPECT_EQ(start.turned(3), start.turned(-1));
}

TEST(LatticeIsometry, QuarterTurnOfAnOblongIsRefused) {
  EXPECT_EQ(error_of([] { LatticeIsometry(6, 4).turned(-1); }),
            "a turn by 270 deg does not fit a grid of 6 x 4 cells; turn it by 180 deg, or use a square tile");
  const LatticeIsometry over(6, 4);
  EXPECT_EQ(over.turned(2).to_lower(over.to_upper(Node{0, 0})), (Node{5, 3}));
}

}  // namespace

}  // namespace asperity::pose_test
