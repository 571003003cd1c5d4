// SPDX-License-Identifier: GPL-3.0-or-later
// Lines through a surface: rows, columns, and straight lines between any two points, on which heights
// are bilinear between the nodes. Rows run along x, columns along y. A place between nodes is not measured
// where one that it lies between was not; a line of such places alone is an Error{bad_value}.
#pragma once

#include <optional>
#include <vector>

#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// Heights of y = j hy, or x = i hx. Throw Error{bad_value} for a row or column that does not exist.
Profile profile_row(const Surface& surface, double j);
Profile profile_column(const Surface& surface, double i);

struct Point {
  double x = 0, y = 0;  // m
};

// `points` heights (2 … 16777216) at equal spacing from `from` to `to`, both included; by default as
// many as keep the spacing within the smaller side of a cell. A periodic surface goes on past its
// rim; on any other, points outside the nodes (0 … (n-1) h) are an Error{bad_value}.
Profile profile_between(const Surface& surface, Point from, Point to, std::optional<double> points = {});

enum class LineDirection { x, y };
// Every row (along x, row 0 first) or every column (along y).
std::vector<Profile> profiles(const Surface& surface, LineDirection along);

// Bilinear height at a point; a periodic surface goes on past its rim, any other clamps to its
// outermost nodes. NaN where one of the nodes around it was not measured.
double height_between(const Surface& surface, Point point);

}  // namespace asperity
