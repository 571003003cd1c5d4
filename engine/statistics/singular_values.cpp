// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/singular_values.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace asperity {

namespace {

double product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

void turn(std::vector<double>& a, std::vector<double>& b, double cosine, double sine) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double was = a[k];
    a[k] = cosine * was - sine * b[k];
    b[k] = sine * was + cosine * b[k];
  }
}

}  // namespace

SingularValues singular_values(TableColumns columns) {
  const std::size_t n = columns.size();
  TableColumns v(n, std::vector<double>(n));
  for (std::size_t k = 0; k < n; ++k) v[k][k] = 1;
  for (int sweep = 0; sweep < 60; ++sweep) {
    bool turned = false;
    for (std::size_t p = 0; p + 1 < n; ++p)
      for (std::size_t q = p + 1; q < n; ++q) {
        const double a = product(columns[p], columns[p]), b = product(columns[q], columns[q]),
                     c = product(columns[p], columns[q]);
        if (!(std::abs(c) > 1e-16 * std::sqrt(a) * std::sqrt(b))) continue;
        turned = true;
        const double zeta = (b - a) / (2 * c);
        const double t = (zeta < 0 ? -1 : 1) / (std::abs(zeta) + std::sqrt(1 + zeta * zeta));
        const double cosine = 1 / std::sqrt(1 + t * t);
        turn(columns[p], columns[q], cosine, cosine * t);
        turn(v[p], v[q], cosine, cosine * t);
      }
    if (!turned) break;
  }
  std::vector<double> lengths;
  for (const auto& column : columns) lengths.push_back(std::sqrt(product(column, column)));
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return lengths[a] > lengths[b]; });
  SingularValues found;
  for (const std::size_t k : order) {
    found.values.push_back(lengths[k]);
    if (lengths[k] > 0)
      for (double& value : columns[k]) value /= lengths[k];
    found.u.push_back(std::move(columns[k]));
    found.v.push_back(std::move(v[k]));
  }
  return found;
}

}  // namespace asperity
