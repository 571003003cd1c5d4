// SPDX-License-Identifier: GPL-3.0-or-later
// The turned-over, turned and shifted lattice: known nodes, exact inverses, composition.
#include "engine/contact/bodies/lattice_isometry.hpp"

#include <cstring>
#include <set>

#include "tests/contact/contacts.hpp"

namespace asperity::lattice_isometry_test {
namespace {

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
  // What lay on the +x side of the centre lies on its +y side, and +y goes to -x.
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
            "a turn by 270 deg was asked of a grid of 6 x 4 cells; only a square tile can be turned by 90 "
            "deg; this "
            "one can be turned by 180 deg");
  const LatticeIsometry over(6, 4);
  EXPECT_EQ(over.turned(2).to_lower(over.to_upper(Node{0, 0})), (Node{5, 3}));
}

}  // namespace
}  // namespace asperity::lattice_isometry_test
