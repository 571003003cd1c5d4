// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/blocked_sums.hpp"

namespace asperity {

double exact_mean(std::span<const double> values, const Range& values_range) {
  if (values.empty() || values_range.min == values_range.max) return values_range.min;
  const int e = scale_exponent(magnitude(values_range));
  const double down = std::ldexp(1.0, -e);
  const auto n = static_cast<double>(values.size());
  const double first =
      blocked_sums<1>(values.size(), [&](std::size_t k) { return std::array{values[k] * down}; })[0] / n;
  const double rest =
      blocked_sums<1>(values.size(), [&](std::size_t k) { return std::array{values[k] * down - first}; })[0] /
      n;
  return std::clamp(std::ldexp(first + rest, e), values_range.min, values_range.max);
}

}  // namespace asperity
