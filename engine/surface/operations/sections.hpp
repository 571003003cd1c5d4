// SPDX-License-Identifier: GPL-3.0-or-later
// Rows, columns and straight lines, bilinear between nodes. A place next to a hole is a hole; a line of
// holes is an Error{bad_value}.
#pragma once

#include <optional>
#include <vector>

#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// y = j hy, or x = i hx. Throw Error{bad_value} outside the grid.
Profile profile_row(const Surface& surface, double j);
Profile profile_column(const Surface& surface, double i);

struct Point {
  double x = 0, y = 0;  // m
};

// `points`: 2 … 16777216, inclusive; default: spacing within the smaller side of a cell. A periodic surface
// wraps; otherwise points outside the nodes are an Error{bad_value}.
Profile profile_between(const Surface& surface, Point from, Point to, std::optional<double> points = {});

enum class LineDirection { x, y };
// In order of rows or columns.
std::vector<Profile> profiles(const Surface& surface, LineDirection along);

// A periodic surface wraps; others clamp to the outermost nodes. NaN next to a hole.
double height_between(const Surface& surface, Point point);

}  // namespace asperity
