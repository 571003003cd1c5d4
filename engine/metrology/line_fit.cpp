// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/line_fit.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/grid.hpp"

namespace asperity {

LineFit fit_line(std::span<const double> x, std::span<const double> y) {
  const auto n = static_cast<double>(x.size());
  const double x_mean = mean(x), y_mean = mean(y);
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double dx = x[k] - x_mean, dy = y[k] - y_mean;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
  LineFit fit;
  fit.slope = xy / xx;
  fit.intercept = y_mean - fit.slope * x_mean;
  double left = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double residual = (y[k] - y_mean) - fit.slope * (x[k] - x_mean);
    left += residual * residual;
  }
  fit.r_squared = yy > 0 ? std::clamp(1 - left / yy, 0.0, 1.0) : 1;
  if (x.size() > 2) fit.slope_error = std::sqrt(left / (n - 2) / xx);
  return fit;
}

}  // namespace asperity
