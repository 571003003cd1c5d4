// SPDX-License-Identifier: GPL-3.0-or-later
// Least-squares line y = intercept + slope·x with its quality.
#pragma once

#include <span>

namespace asperity {

struct LineFit {
  double slope = 0, intercept = 0;
  double slope_error = 0;  // from the residuals; 0 for two points
  double r_squared = 0;    // explained share of the variance of y; 1 for constant y
};

// Equal lengths; at least two different x. Cost O(n).
LineFit fit_line(std::span<const double> x, std::span<const double> y);

}  // namespace asperity
