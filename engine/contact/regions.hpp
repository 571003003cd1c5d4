// SPDX-License-Identifier: GPL-3.0-or-later
// Connected regions of a set of nodes, and the length of their outlines in edges. Rows are cut into
// runs and runs of neighbouring rows are joined in a union-find forest, so the cost is O(n) reads and
// memory grows with the number of runs, not of nodes. It knows nothing of pressure or of metres.
#pragma once

#include <cstdint>
#include <span>

#include "engine/core/memory.hpp"

namespace asperity {

enum class Neighbours { four, eight };  // joined by an edge, or also by a corner

// Nodes in each region of mask != 0, in the order in which rows from j = 0 first meet them. The mask
// is stored row by row and must hold nx·ny values. With `wrap` the last column touches the first and
// the last row the first.
Array<std::int64_t> region_sizes(std::span<const std::uint8_t> mask, int nx, int ny, Neighbours neighbours,
                                 bool wrap);

// Edges between a node inside the set and one outside it. The rim of a tile that does not wrap is no
// edge: nothing is known of what lies beyond.
struct BoundaryEdges {
  std::int64_t between_columns = 0;  // between (i, j) and (i+1, j)
  std::int64_t between_rows = 0;     // between (i, j) and (i, j+1)
};
BoundaryEdges boundary_edges(std::span<const std::uint8_t> mask, int nx, int ny, bool wrap);

}  // namespace asperity
