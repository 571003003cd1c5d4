// SPDX-License-Identifier: GPL-3.0-or-later
// The points of a fit that count, checked: finite, with weights above 0, and enough of them.
#pragma once

#include <vector>

#include "engine/statistics/curve_fit.hpp"

namespace asperity {

struct UsedPoints {
  std::vector<double> x, y, weights;
};

// Throws Error{bad_value} as told in curve_fit.hpp.
UsedPoints used_points(const FitPoints& points, std::size_t parameters, double confidence);

}  // namespace asperity
