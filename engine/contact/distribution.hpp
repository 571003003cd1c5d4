// SPDX-License-Identifier: GPL-3.0-or-later
// Histogram as a probability density: bins of equal width from zero, or of equal ratio between the extremes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace asperity {

struct HistogramOptions {
  int bins = 50;     // 1 … 100000
  bool log = false;  // bins of equal ratio
};

struct Histogram {
  std::vector<double> edges;         // bins + 1, ascending, in the unit of the values
  std::vector<std::int64_t> counts;  // in [edge k, edge k+1); the last bin includes its upper edge
  std::vector<double> density;       // counts / (values · bin width): integrates to 1
  std::int64_t values = 0;
  double mean = 0;
};

// Values positive and finite, at least one. O(values).
Histogram make_histogram(std::span<const double> values, const HistogramOptions& options);

}  // namespace asperity
