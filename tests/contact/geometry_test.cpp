// SPDX-License-Identifier: GPL-3.0-or-later
// Combined heights of two bodies.
#include "engine/contact/bodies/geometry.hpp"

#include "tests/contact/contacts.hpp"

namespace asperity::geometry_test {
namespace {

using test::error_of;
using test::random_surface;
using test::row_of;

TEST(ContactGeometry, UnderAFlatSharesTheLowerHeights) {
  const Scene scene = test::boxes(row_of({0, 1, 3, 6}), 1);
  const ContactGeometry geometry(scene, LatticeIsometry(4, 1));
  EXPECT_EQ(geometry.combined().data(), scene.lower.heights().data());
  EXPECT_EQ(geometry.peak_to_valley(), 6);
  EXPECT_TRUE(geometry.upper_is_flat());
}

TEST(ContactGeometry, LowerNodeMeetsTheMirroredUpperNode) {
  const Scene scene = test::scene_of(row_of({0, 1, 3, 6}), row_of({10, 20, 30, 50}), 1);
  const ContactGeometry geometry(scene, LatticeIsometry(4, 1));
  const std::vector<double> expected = {50, 31, 23, 16};
  EXPECT_EQ(std::vector<double>(geometry.combined().values().begin(), geometry.combined().values().end()),
            expected);
  EXPECT_EQ(geometry.peak_to_valley(), 34);
  EXPECT_FALSE(geometry.upper_is_flat());
}

TEST(ContactGeometry, PlacementMovesTheUpperBodyOnly) {
  const Surface lower = random_surface(9, 9, 1), upper = random_surface(9, 9, 2);
  const LatticeIsometry placement = LatticeIsometry(9, 9).turned(3).shifted(4, 1);
  const ContactGeometry geometry(test::scene_of(lower, upper, 1), placement);
  for (int j = 0; j < 9; ++j)
    for (int i = 0; i < 9; ++i) {
      const auto node = placement.to_upper(LatticeIsometry::Node{i, j});
      EXPECT_EQ(geometry.combined()(i, j), lower.height(i, j) + upper.height(node.i, node.j));
    }
}

TEST(ContactGeometry, HeightsThatOverflowAreRefused) {
  const Scene scene = test::scene_of(row_of({1e308, 0}), row_of({0, 1e308}), 1);
  EXPECT_NE(
      error_of([&] { ContactGeometry(scene, LatticeIsometry(2, 1)); }).find("leave the range of a double"),
      std::string::npos);
  const Scene spread = test::boxes(row_of({1.5e308, -1.5e308}), 1);
  EXPECT_NE(
      error_of([&] { ContactGeometry(spread, LatticeIsometry(2, 1)); }).find("leave the range of a double"),
      std::string::npos);
}

}  // namespace
}  // namespace asperity::geometry_test
