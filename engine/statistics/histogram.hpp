// SPDX-License-Identifier: GPL-3.0-or-later
// Histogram with bins by Freedman & Diaconis (1981), width 2 IQR n^(-1/3) rounded to equal bins over the
// range, or by number or edges. A bin contains its lower edge, the last bin both.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace asperity {

struct HistogramBins {
  std::optional<int> count;     // over the range
  std::vector<double> edges{};  // or ascending edges
};

struct ValueHistogram {
  std::vector<double> edges;
  std::vector<std::size_t> counts;
  std::vector<double> density;       // integral 1
  std::size_t values = 0;            // in bins
  std::size_t below = 0, above = 0;  // outside given edges
  std::size_t left_out = 0;
  std::string rule;  // "Freedman-Diaconis", "8 bins as given"
};

// Throws Error{bad_value} without finite values, for equal values without edges, for edges that do not
// ascend, and unless 1 to 10000 bins. O(n log n).
ValueHistogram value_histogram(std::span<const double> values, const HistogramBins& bins = {});

}  // namespace asperity
