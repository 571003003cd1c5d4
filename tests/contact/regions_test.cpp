// SPDX-License-Identifier: GPL-3.0-or-later
// Connected regions and outlines against a node-by-node flood fill.
#include "engine/contact/regions.hpp"

#include <vector>

#include "tests/contact/contacts.hpp"

namespace asperity::regions_test {
namespace {

struct Mask {
  int nx, ny;
  std::vector<std::uint8_t> on;
};

Mask mask_of(const std::vector<std::string>& rows) {
  Mask mask{static_cast<int>(rows.front().size()), static_cast<int>(rows.size()), {}};
  for (const std::string& row : rows)
    for (const char c : row) mask.on.push_back(c == '#' ? 1 : 0);
  return mask;
}

std::vector<std::int64_t> sizes(const Mask& mask, Neighbours neighbours, bool wrap) {
  const auto found = region_sizes(mask.on, mask.nx, mask.ny, neighbours, wrap);
  return {found.begin(), found.end()};
}

std::vector<std::int64_t> flooded(Mask mask, Neighbours neighbours, bool wrap) {
  std::vector<std::int64_t> result;
  for (int start = 0; start < mask.nx * mask.ny; ++start) {
    if (mask.on[static_cast<std::size_t>(start)] == 0) continue;
    std::vector<int> open = {start};
    mask.on[static_cast<std::size_t>(start)] = 0;
    std::int64_t count = 0;
    while (!open.empty()) {
      const int node = open.back();
      open.pop_back();
      ++count;
      for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di) {
          if (neighbours == Neighbours::four && di != 0 && dj != 0) continue;
          int i = node % mask.nx + di, j = node / mask.nx + dj;
          if (wrap) {
            i = (i + mask.nx) % mask.nx;
            j = (j + mask.ny) % mask.ny;
          }
          if (i < 0 || j < 0 || i >= mask.nx || j >= mask.ny) continue;
          std::uint8_t& value = mask.on[static_cast<std::size_t>(j * mask.nx + i)];
          if (value == 0) continue;
          value = 0;
          open.push_back(j * mask.nx + i);
        }
    }
    result.push_back(count);
  }
  return result;
}

TEST(Regions, CornersJoinOnlyEightNeighbours) {
  const Mask mask = mask_of({"##..", "..#.", "...#"});
  EXPECT_EQ(sizes(mask, Neighbours::four, false), (std::vector<std::int64_t>{2, 1, 1}));
  EXPECT_EQ(sizes(mask, Neighbours::eight, false), (std::vector<std::int64_t>{4}));
}

TEST(Regions, WrapJoinsAcrossRimsAndCorners) {
  const Mask mask = mask_of({"#..#", "....", "....", "#..#"});
  EXPECT_EQ(sizes(mask, Neighbours::eight, false).size(), 4U);
  EXPECT_EQ(sizes(mask, Neighbours::four, true), (std::vector<std::int64_t>{4}));
  const Mask corners = mask_of({"#...", "....", "...#"});
  EXPECT_EQ(sizes(corners, Neighbours::four, true).size(), 2U);
  EXPECT_EQ(sizes(corners, Neighbours::eight, true).size(), 1U);
}

TEST(Regions, BranchesThatMeetLateAreOneRegion) {
  EXPECT_EQ(sizes(mask_of({"#.#.#", "#.#.#", "#####"}), Neighbours::four, false),
            (std::vector<std::int64_t>{11}));
  EXPECT_EQ(sizes(mask_of({"#####", "#...#", "#.#.#", "#...#", "#####"}), Neighbours::four, false),
            (std::vector<std::int64_t>{16, 1}));
}

TEST(Regions, EmptyAndFullTiles) {
  EXPECT_TRUE(sizes(mask_of({"...", "..."}), Neighbours::eight, true).empty());
  for (const bool wrap : {false, true})
    EXPECT_EQ(sizes(mask_of({"###", "###"}), Neighbours::four, wrap), (std::vector<std::int64_t>{6}));
  EXPECT_EQ(sizes(mask_of({"#"}), Neighbours::eight, true), (std::vector<std::int64_t>{1}));
}

TEST(Regions, AgreeWithAFloodFillOnRandomTiles) {
  std::uint64_t seed = 0;
  for (const auto& [nx, ny] : {std::pair{1, 1}, {1, 9}, {9, 1}, {2, 7}, {7, 2}, {13, 11}, {40, 33}})
    for (const double share : {0.1, 0.4, 0.6, 0.9})
      for (int repeat = 0; repeat < 10; ++repeat) {
        const Stream stream(++seed, "mask");
        Mask mask{nx, ny, {}};
        for (int k = 0; k < nx * ny; ++k)
          mask.on.push_back(stream.uniform(static_cast<std::uint64_t>(k)) < share ? 1 : 0);
        for (const Neighbours neighbours : {Neighbours::four, Neighbours::eight})
          for (const bool wrap : {false, true})
            ASSERT_EQ(sizes(mask, neighbours, wrap), flooded(mask, neighbours, wrap))
                << nx << " x " << ny << " seed " << seed << " wrap " << wrap;
      }
}

TEST(BoundaryEdges, CountsBothDirectionsApart) {
  const Mask mask = mask_of({"....", ".##.", "...."});
  const BoundaryEdges edges = boundary_edges(mask.on, 4, 3, false);
  EXPECT_EQ(edges.between_columns, 2);
  EXPECT_EQ(edges.between_rows, 4);
}

TEST(BoundaryEdges, TheRimOfATileIsNoEdgeUnlessItWraps) {
  const Mask mask = mask_of({"##..", "##.."});
  const BoundaryEdges open = boundary_edges(mask.on, 4, 2, false),
                      closed = boundary_edges(mask.on, 4, 2, true);
  EXPECT_EQ(open.between_columns, 2);
  EXPECT_EQ(open.between_rows, 0);
  EXPECT_EQ(closed.between_columns, 4);
  EXPECT_EQ(closed.between_rows, 0);
  const Mask full = mask_of({"###", "###"});
  for (const bool wrap : {false, true}) {
    const BoundaryEdges none = boundary_edges(full.on, 3, 2, wrap);
    EXPECT_EQ(none.between_columns + none.between_rows, 0);
  }
}

bool open(const Mask& mask, PathDirection along, bool wrap) {
  return has_open_path(mask.on, mask.nx, mask.ny, along, wrap);
}

TEST(OpenPath, JoinsSidesByEdgesAndWrapsAcrossOnly) {
  const Mask winding = mask_of({"#.###", "#...#", "###.#"});
  EXPECT_TRUE(open(winding, PathDirection::y, false));
  EXPECT_FALSE(open(winding, PathDirection::x, false));
  // Corners do not join.
  EXPECT_FALSE(open(mask_of({".#", "#."}), PathDirection::x, false));
  // Around the tile, across the path.
  const Mask around = mask_of({"..###", "#####", ".....", "#####"});
  EXPECT_TRUE(open(around, PathDirection::x, false));
  const Mask over = mask_of({"...##", "#####", "#####", "##..."});
  EXPECT_FALSE(open(over, PathDirection::x, false));
  EXPECT_TRUE(open(over, PathDirection::x, true));
  EXPECT_FALSE(open(over, PathDirection::y, true));
  EXPECT_TRUE(open(mask_of({"."}), PathDirection::y, true));
  EXPECT_FALSE(open(mask_of({"#"}), PathDirection::y, true));
}

TEST(OpenPath, IsTheComplementOfAWall) {
  // In the plane, a four-neighbour path along x is open exactly if no eight-neighbour wall joins the other
  // sides.
  std::uint64_t state = 12345;
  for (int trial = 0; trial < 400; ++trial) {
    Mask mask{9, 7, {}};
    for (int k = 0; k < mask.nx * mask.ny; ++k) {
      state = state * 6364136223846793005U + 1442695040888963407U;
      mask.on.push_back((state >> 33) % 100 < 42 ? 1 : 0);
    }
    bool blocked = false;
    std::vector<int> next;
    std::vector<std::uint8_t> seen(mask.on.size(), 0);
    const auto visit = [&](int i, int j) {
      if (i < 0 || j < 0 || i >= mask.nx || j >= mask.ny) return;
      const auto k = static_cast<std::size_t>(j * mask.nx + i);
      if (mask.on[k] == 0 || seen[k] != 0) return;
      seen[k] = 1;
      next.push_back(j * mask.nx + i);
    };
    for (int i = 0; i < mask.nx; ++i) visit(i, 0);
    while (!next.empty()) {
      const int node = next.back();
      next.pop_back();
      blocked |= node / mask.nx == mask.ny - 1;
      for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di) visit(node % mask.nx + di, node / mask.nx + dj);
    }
    EXPECT_EQ(open(mask, PathDirection::x, false), !blocked);
  }
}

}  // namespace
}  // namespace asperity::regions_test
