// SPDX-License-Identifier: GPL-3.0-or-later
// Placements by seed: allowed turns and shifts.
#include <gtest/gtest.h>

#include <set>

#include "engine/specimen/specimen_pair.hpp"

namespace asperity::placement_test {
namespace {

TEST(Placement, IsAFunctionOfTheSeed) {
  const Grid square{16, 16, 1, 1};
  EXPECT_EQ(draw_placement(square, Boundary::periodic, 5), draw_placement(square, Boundary::periodic, 5));
  EXPECT_NE(draw_placement(square, Boundary::periodic, 5), draw_placement(square, Boundary::periodic, 6));
}

TEST(Placement, DrawsEveryTurnAndEveryShift) {
  std::set<int> turns, across, along;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const LatticeIsometry placement = draw_placement(Grid{16, 16, 1, 1}, Boundary::periodic, seed);
    turns.insert(placement.quarters());
    across.insert(placement.shift_x());
    along.insert(placement.shift_y());
  }
  EXPECT_EQ(turns, (std::set<int>{0, 1, 2, 3}));
  EXPECT_EQ(across.size(), 16U);
  EXPECT_EQ(along.size(), 16U);
}

TEST(Placement, OblongTilesTurnByHalfTurnsOnly) {
  for (const Grid& grid : {Grid{16, 8, 1, 1}, Grid{16, 16, 1, 2}}) {
    std::set<int> turns;
    for (std::uint64_t seed = 0; seed < 100; ++seed)
      turns.insert(draw_placement(grid, Boundary::periodic, seed).quarters());
    EXPECT_EQ(turns, (std::set<int>{0, 2}));
  }
}

TEST(Placement, AFreeBoundaryIsNeverShifted) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const LatticeIsometry placement = draw_placement(Grid{16, 16, 1, 1}, Boundary::free, seed);
    EXPECT_EQ(placement.shift_x(), 0);
    EXPECT_EQ(placement.shift_y(), 0);
  }
}

}  // namespace
}  // namespace asperity::placement_test
