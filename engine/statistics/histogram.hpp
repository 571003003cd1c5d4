// SPDX-License-Identifier: GPL-3.0-or-later
// How often values fall into bins. The bins follow a rule that the result names: the width of Freedman &
// Diaconis (1981), 2 IQR n^(-1/3), rounded so that a whole number of equal bins covers the values; a number
// of bins that is given; or edges that are given. A bin holds its lower edge, the last one both.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace asperity {

struct HistogramBins {
  std::optional<int> count;     // equal bins between the least and the greatest value
  std::vector<double> edges{};  // or these, ascending
};

struct ValueHistogram {
  std::vector<double> edges;  // one more than bins
  std::vector<std::size_t> counts;
  std::vector<double> density;       // share of the values per width: integrates to 1 over the bins
  std::size_t values = 0;            // that lie in the bins
  std::size_t below = 0, above = 0;  // of the edges that were given
  std::size_t left_out = 0;          // not finite
  std::string rule;                  // "Freedman-Diaconis", "8 bins as given", "edges as given"
};

// Throws Error{bad_value} when no value is finite, when all values are equal and no edges are given, for
// edges that do not ascend, and for fewer than 1 or more than 10000 bins. Cost: n log n.
ValueHistogram value_histogram(std::span<const double> values, const HistogramBins& bins = {});

}  // namespace asperity
