// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/parameters/areal_slopes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/memory.hpp"
#include "engine/core/parallel.hpp"
#include "engine/metrology/blocked_sums.hpp"

namespace asperity {

namespace {

enum Term { edges_x, edges_y, crosses, cells, terms };

// Sum and count per kind of difference.
struct SlopeSums {
  std::array<double, terms> sum{}, count{};
  void add(Term term, double value) {
    if (std::isnan(value)) return;
    sum[term] += value;
    count[term] += 1;
  }
};

// √(1 + s²) - 1 without cancellation.
double excess(double squared) { return squared / (1 + std::sqrt(1 + squared)); }

class SlopesOfRows {
 public:
  explicit SlopesOfRows(const Surface& surface)
      : z_(surface.measured_heights()), hx_(surface.grid().hx()), hy_(surface.grid().hy()) {}

  SlopeSums row(int j) const {
    SlopeSums sums;
    const std::span<const double> here = z_.row(j);
    const bool last = j + 1 == z_.ny();
    const std::span<const double> above = z_.row(last ? j : j + 1);
    for (std::size_t i = 0; i < here.size(); ++i) {
      if (i + 1 < here.size()) {
        const double a = (here[i + 1] - here[i]) / hx_;
        sums.add(edges_x, a * a);
        if (!last) {
          const double b = (above[i + 1] - above[i]) / hx_, c = (above[i] - here[i]) / hy_,
                       d = (above[i + 1] - here[i + 1]) / hy_;
          sums.add(cells, (excess(a * a + d * d) + excess(b * b + c * c) + excess(a * a + c * c) +
                           excess(b * b + d * d)) /
                              4);
        }
      }
      if (!last) {
        const double c = (above[i] - here[i]) / hy_;
        sums.add(edges_y, c * c);
      }
    }
    if (j >= 3 && j + 3 < z_.ny())
      for (int i = 3; i + 3 < z_.nx(); ++i) {
        const double x = seven([&](int k) { return z_(i + k, j); }) / hx_,
                     y = seven([&](int k) { return z_(i, j + k); }) / hy_;
        sums.add(crosses, x * x + y * y + 0 * z_(i, j));  // NaN if the middle is missing
      }
    return sums;
  }

 private:
  template <class Height>
  static double seven(const Height& z) {
    return (45 * (z(1) - z(-1)) - 9 * (z(2) - z(-2)) + (z(3) - z(-3))) / 60;
  }

  const Field& z_;
  double hx_, hy_;
};

}  // namespace

ArealSlopes areal_slopes(const Surface& surface) {
  const SlopesOfRows slopes(surface);
  const int ny = surface.grid().ny;
  std::array<Array<double>, terms> sum, count;
  for (int t = 0; t < terms; ++t) {
    sum[static_cast<std::size_t>(t)].resize(static_cast<std::size_t>(ny));
    count[static_cast<std::size_t>(t)].resize(static_cast<std::size_t>(ny));
  }
  for_each_row(ny, [&](int j) {
    const SlopeSums row = slopes.row(j);
    for (std::size_t t = 0; t < terms; ++t) {
      sum[t][static_cast<std::size_t>(j)] = row.sum[t];
      count[t][static_cast<std::size_t>(j)] = row.count[t];
    }
  });
  std::array<double, terms> total{}, number{};
  for (std::size_t t = 0; t < terms; ++t) total[t] = block_sum(sum[t]), number[t] = block_sum(count[t]);
  const auto mean_square = [&](Term term) { return number[term] > 0 ? total[term] / number[term] : 0; };
  ArealSlopes result;
  if (number[edges_x] > 0 || number[edges_y] > 0)
    result.Sdq = std::sqrt(mean_square(edges_x) + mean_square(edges_y));
  if (number[crosses] > 0) result.Sdq_seven = std::sqrt(mean_square(crosses));
  if (number[cells] > 0) result.Sdr = mean_square(cells);
  result.cells = static_cast<std::size_t>(number[cells]);
  return result;
}

}  // namespace asperity
