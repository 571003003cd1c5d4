// SPDX-License-Identifier: GPL-3.0-or-later
// The straight line y = intercept + slope·x of least squares, with what it says of its own quality.
#pragma once

#include <span>

namespace asperity {

struct LineFit {
  double slope = 0, intercept = 0;
  double slope_error = 0;  // standard error of the slope from the residuals; 0 for two points
  double r_squared = 0;    // share of the variance of y explained; 1 where y does not vary
};

// x and y of one length, at least two different x. Cost O(n).
LineFit fit_line(std::span<const double> x, std::span<const double> y);

}  // namespace asperity
