// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/distribution.hpp"

#include <algorithm>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/grid.hpp"

namespace asperity {

namespace {

std::vector<double> linear_edges(double greatest, int bins) {
  std::vector<double> edges;
  for (int k = 0; k <= bins; ++k) edges.push_back(greatest * (static_cast<double>(k) / bins));
  return edges;
}

std::vector<double> geometric_edges(double least, double greatest, int bins) {
  if (!(least < greatest)) {
    least *= 0.5;
    greatest *= 2;
  }
  const double ratio = elementary::log(greatest / least);
  std::vector<double> edges;
  for (int k = 0; k <= bins; ++k)
    edges.push_back(least * elementary::exp(ratio * (static_cast<double>(k) / bins)));
  edges.front() = least;
  edges.back() = greatest;
  return edges;
}

}  // namespace

Histogram make_histogram(std::span<const double> values, const HistogramOptions& options) {
  const Range limits = range(values);
  Histogram result;
  result.edges = options.log ? geometric_edges(limits.min, limits.max, options.bins)
                             : linear_edges(limits.max, options.bins);
  result.values = static_cast<std::int64_t>(values.size());
  result.mean = mean(values);
  result.counts.assign(static_cast<std::size_t>(options.bins), 0);
  for (const double value : values) {
    const auto above =
        std::upper_bound(result.edges.begin(), result.edges.end(), value) - result.edges.begin();
    const auto bin = std::clamp<std::ptrdiff_t>(above - 1, 0, options.bins - 1);
    ++result.counts[static_cast<std::size_t>(bin)];
  }
  for (std::size_t k = 0; k < result.counts.size(); ++k) {
    const double width = result.edges[k + 1] - result.edges[k];
    result.density.push_back(static_cast<double>(result.counts[k]) /
                             (static_cast<double>(result.values) * width));
  }
  return result;
}

}  // namespace asperity
