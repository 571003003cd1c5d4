// SPDX-License-Identifier: GPL-3.0-or-later
// Height: (c[k-1] + 4 c[k] + c[k+1])/6. The rim coefficient is the height; the one beyond continues linearly.
#include "engine/metrology/registration/natural_spline.hpp"

#include <algorithm>
#include <array>

#include "engine/surface/parallel_rows.hpp"

namespace asperity::registration {

namespace {

// Pivots of the elimination of (1, 4, 1).
std::vector<double> pivots(int n) {
  std::vector<double> inverse(static_cast<std::size_t>(std::max(n - 2, 0)));
  double below = 0;
  for (double& entry : inverse) entry = below = 1 / (4 - below);
  return inverse;
}

struct Basis {
  std::array<double, 4> weight, slope;
};
Basis basis(double t) {
  const double s = 1 - t;
  return {{s * s * s / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * s * s + 3 * s * s * s) / 6,
           t * t * t / 6},
          {-0.5 * s * s, (1.5 * t - 2) * t, (2 - 1.5 * s) * s, 0.5 * t * t}};
}

}  // namespace

NaturalSpline::NaturalSpline(const Field& heights) : coefficients_(heights.nx() + 2, heights.ny() + 2) {
  Field& c = coefficients_;
  const int nx = heights.nx(), ny = heights.ny();
  const std::vector<double> in_row = pivots(nx), in_column = pivots(ny);
  for_each_row(ny, [&](int j) {
    double* line = c.row(j + 1).data() + 1;
    std::copy(heights.row(j).begin(), heights.row(j).end(), line);
    double before = line[0];
    for (int i = 1; i < nx - 1; ++i) {
      const double end = i == nx - 2 ? line[nx - 1] : 0;
      line[i] = before = (6 * line[i] - before - end) * in_row[static_cast<std::size_t>(i - 1)];
    }
    for (int i = nx - 3; i >= 1; --i) line[i] -= in_row[static_cast<std::size_t>(i - 1)] * line[i + 1];
    line[-1] = 2 * line[0] - line[1];
    line[nx] = 2 * line[nx - 1] - line[nx - 2];
  });
  // Blocks of columns stay in the cache.
  constexpr std::size_t columns = 64;
  for_each_block(static_cast<std::size_t>(nx + 2), columns, [&](std::size_t begin, std::size_t end_column) {
    const int first = static_cast<int>(begin), last = static_cast<int>(end_column);
    for (int j = 1; j < ny - 1; ++j) {
      const double pivot = in_column[static_cast<std::size_t>(j - 1)];
      const double* before = c.row(j).data();
      const double* end = c.row(ny).data();
      double* line = c.row(j + 1).data();
      const double share = j == ny - 2 ? 1 : 0;
      for (int i = first; i < last; ++i) line[i] = (6 * line[i] - before[i] - share * end[i]) * pivot;
    }
    for (int j = ny - 3; j >= 1; --j) {
      const double pivot = in_column[static_cast<std::size_t>(j - 1)];
      const double* after = c.row(j + 2).data();
      double* line = c.row(j + 1).data();
      for (int i = first; i < last; ++i) line[i] -= pivot * after[i];
    }
    for (int i = first; i < last; ++i) {
      c(i, 0) = 2 * c(i, 1) - c(i, 2);
      c(i, ny + 1) = 2 * c(i, ny) - c(i, ny - 1);
    }
  });
}

NaturalSpline::Value NaturalSpline::at(double x, double y) const {
  const int i = std::min(static_cast<int>(x), nx() - 2), j = std::min(static_cast<int>(y), ny() - 2);
  const Basis bx = basis(x - i), by = basis(y - j);
  Value value{0, 0, 0};
  for (int m = 0; m < 4; ++m) {
    const double* c = coefficients_.row(j + m).data() + i;
    const auto at = static_cast<std::size_t>(m);
    const double height =
        bx.weight[0] * c[0] + bx.weight[1] * c[1] + bx.weight[2] * c[2] + bx.weight[3] * c[3];
    const double slope = bx.slope[0] * c[0] + bx.slope[1] * c[1] + bx.slope[2] * c[2] + bx.slope[3] * c[3];
    value.height += by.weight[at] * height;
    value.along_x += by.weight[at] * slope;
    value.along_y += by.slope[at] * height;
  }
  return value;
}

}  // namespace asperity::registration
