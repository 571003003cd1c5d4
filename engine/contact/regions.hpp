// SPDX-License-Identifier: GPL-3.0-or-later
// Connected regions of a set of nodes, and the length of their outlines in edges. A union-find forest of row
// runs: O(n) reads, memory in proportion to the runs.
#pragma once

#include <cstdint>
#include <span>

#include "engine/core/memory.hpp"

namespace asperity {

enum class Neighbours { four, eight };  // joined by an edge, or also by a corner

// Nodes in each region of mask != 0 (nx·ny values, row by row), in order of first occurrence. `wrap`: first
// and last columns and rows touch.
Array<std::int64_t> region_sizes(std::span<const std::uint8_t> mask, int nx, int ny, Neighbours neighbours,
                                 bool wrap);

enum class PathDirection { x, y };
// Whether nodes with mask == 0 join the first column to the last one (along x) or the first row to the last
// (along y), by edges. `wrap`: across the path, the tile is periodic.
bool has_open_path(std::span<const std::uint8_t> mask, int nx, int ny, PathDirection along, bool wrap);

// Between a node in the set and one outside; without `wrap` the rim does not count.
struct BoundaryEdges {
  std::int64_t between_columns = 0;  // between (i, j) and (i+1, j)
  std::int64_t between_rows = 0;     // between (i, j) and (i, j+1)
};
BoundaryEdges boundary_edges(std::span<const std::uint8_t> mask, int nx, int ny, bool wrap);

}  // namespace asperity
