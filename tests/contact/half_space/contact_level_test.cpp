// SPDX-License-Identifier: GPL-3.0-or-later
// Nested grids: sizes, common nodes, prolongation of linear fields.
#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"

#include <gtest/gtest.h>

namespace asperity::contact_level_test {
namespace {

TEST(LevelTransfer, HalvesSidesDownToThirtyTwo) {
  const auto half = coarser({128, 96, 2, Boundary::periodic, 1});
  ASSERT_TRUE(half);
  EXPECT_EQ(half->shape.nx, 64);
  EXPECT_EQ(half->shape.ny, 48);
  EXPECT_EQ(half->shape.aspect, 2);
  EXPECT_FALSE(coarser({32, 63, 1, Boundary::periodic, 1}));
  const auto one_way = coarser({256, 1, 1, Boundary::free, 1});
  ASSERT_TRUE(one_way);
  EXPECT_EQ(one_way->shape.ny, 1);
  EXPECT_EQ(one_way->shape.aspect, .5);
}

TEST(LevelTransfer, OddPeriodicSidesCloseOnThemselves) {
  const auto next = coarser({101, 101, 1, Boundary::periodic, 1});
  ASSERT_TRUE(next);
  EXPECT_EQ(next->shape.nx % 4, 0);
  EXPECT_DOUBLE_EQ(next->pitch_x * next->shape.nx, 101);
  const auto free = coarser({101, 101, 1, Boundary::free, 1});
  EXPECT_EQ(free->shape.nx, 51);
  EXPECT_EQ(free->pitch_x, 2);
}

TEST(LevelTransfer, EvenSidesKeepTheirNodes) {
  const LevelShape fine{64, 64, 1, Boundary::periodic, 1};
  Array<double> field(fine.nodes());
  for (std::size_t k = 0; k < field.size(); ++k) field[k] = static_cast<double>(k * k % 101);
  const auto coarse = coarser(fine);
  const Array<double> down = restrict_to(fine, *coarse, field);
  Array<double> up(fine.nodes());
  prolong(*coarse, down, 3, fine, up);
  for (int j = 0; j < 64; j += 2)
    for (int i = 0; i < 64; i += 2) {
      const auto k = static_cast<std::size_t>(j * 64 + i);
      EXPECT_EQ(down[static_cast<std::size_t>(j / 2 * 32 + i / 2)], field[k]);
      EXPECT_EQ(up[k], 3 * field[k]);
    }
}

TEST(LevelTransfer, KeepsALinearFieldOnAFreeTile) {
  for (const int nx : {64, 65, 101}) {
    const LevelShape fine{nx, 80, 1, Boundary::free, 1};
    Array<double> field(fine.nodes()), up(fine.nodes());
    for (int j = 0; j < 80; ++j)
      for (int i = 0; i < nx; ++i) field[static_cast<std::size_t>(j * nx + i)] = 1.5 * i - .25 * j;
    const auto coarse = coarser(fine);
    prolong(*coarse, restrict_to(fine, *coarse, field), 1, fine, up);
    // Without the last row and column: outside the coarse nodes.
    for (int j = 0; j < 79; ++j)
      for (int i = 0; i < nx - 1; ++i)
        EXPECT_NEAR(up[static_cast<std::size_t>(j * nx + i)], 1.5 * i - .25 * j, 1e-12);
  }
}

}  // namespace
}  // namespace asperity::contact_level_test
