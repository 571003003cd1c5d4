// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/histogram.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

constexpr int most_bins = 10'000;

// Linear interpolation (type 7 of Hyndman & Fan); `sorted` ascends.
double quantile_of(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto k = static_cast<std::size_t>(place);
  if (k + 1 >= sorted.size()) return sorted.back();
  const double part = place - static_cast<double>(k);
  return sorted[k] * (1 - part) + sorted[k + 1] * part;
}

int bins_by_rule(const std::vector<double>& sorted, std::string& rule) {
  constexpr double most_by_rule = 200;
  const auto n = static_cast<double>(sorted.size());
  const double range = sorted.back() - sorted.front();
  const double width = 2 * (quantile_of(sorted, 0.75) - quantile_of(sorted, 0.25)) / elementary::cbrt(n);
  if (width > 0 && range / width <= most_by_rule) {
    rule = "Freedman-Diaconis";
    return std::max(1, static_cast<int>(std::ceil(range / width - 1e-9)));
  }
  rule = "Sturges (the quartiles give no width for Freedman-Diaconis)";
  return static_cast<int>(std::ceil(elementary::log2(n))) + 1;
}

std::vector<double> equal_edges(double low, double high, int bins) {
  std::vector<double> edges;
  for (int k = 0; k <= bins; ++k) {
    const double share = static_cast<double>(k) / bins;
    edges.push_back(low * (1 - share) + high * share);
  }
  return edges;
}

std::vector<double> edges_of(const std::vector<double>& sorted, const HistogramBins& bins,
                             std::string& rule) {
  if (!bins.edges.empty()) {
    if (bins.edges.size() < 2 || bins.edges.size() > most_bins + 1)
      refuse("`bins` has " + counted(bins.edges.size(), "edge"),
             "give from 2 to " + std::to_string(most_bins + 1) + ", or a number of bins");
    for (std::size_t k = 0; k < bins.edges.size(); ++k) {
      if (!std::isfinite(bins.edges[k])) refuse("edge " + std::to_string(k + 1) + " of `bins` is not finite");
      if (k > 0 && !(bins.edges[k] > bins.edges[k - 1]))
        refuse("edge " + std::to_string(k + 1) + " of `bins`, " + format_short(bins.edges[k]) +
                   ", is not above the one before, " + format_short(bins.edges[k - 1]),
               "edges ascend");
    }
    rule = "edges as given";
    return bins.edges;
  }
  if (bins.count && (*bins.count < 1 || *bins.count > most_bins))
    refuse("`bins` is " + std::to_string(*bins.count), "give from 1 to " + std::to_string(most_bins));
  if (!(sorted.back() > sorted.front()))
    refuse("all " + std::to_string(sorted.size()) + " values are " + format_short(sorted.front()) +
               ", and bins have no width between equal values",
           "give `bins` the edges, such as {0, 1, 2}");
  if (!bins.count) return equal_edges(sorted.front(), sorted.back(), bins_by_rule(sorted, rule));
  rule = std::to_string(*bins.count) + (*bins.count == 1 ? " bin as given" : " bins as given");
  return equal_edges(sorted.front(), sorted.back(), *bins.count);
}

}  // namespace

ValueHistogram value_histogram(std::span<const double> values, const HistogramBins& bins) {
  ValueHistogram found;
  std::vector<double> sorted;
  for (const double value : values)
    if (std::isfinite(value)) sorted.push_back(value);
  found.left_out = values.size() - sorted.size();
  if (sorted.empty())
    refuse("there is no number to count",
           values.empty() ? "" : std::to_string(values.size()) + " cells are empty or not finite");
  std::ranges::sort(sorted);
  found.edges = edges_of(sorted, bins, found.rule);
  found.counts.resize(found.edges.size() - 1);
  for (const double value : sorted) {
    if (value < found.edges.front()) {
      ++found.below;
    } else if (value > found.edges.back()) {
      ++found.above;
    } else {
      const auto upper = std::ranges::upper_bound(found.edges, value) - found.edges.begin();
      ++found.counts[std::min(static_cast<std::size_t>(upper), found.edges.size() - 1) - 1];
      ++found.values;
    }
  }
  for (std::size_t k = 0; k < found.counts.size(); ++k)
    found.density.push_back(found.values == 0
                                ? 0
                                : static_cast<double>(found.counts[k]) / static_cast<double>(found.values) /
                                      (found.edges[k + 1] - found.edges[k]));
  return found;
}

}  // namespace asperity
