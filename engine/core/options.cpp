// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/options.hpp"

#include <cmath>

#include "engine/core/require.hpp"

namespace asperity {

namespace {
std::string show_bound(double value, Dimension dimension) {
  return dimension == dimension::number || value == 0 ? format_short(value, 10)
                                                      : format_quantity(value, dimension);
}
}  // namespace

bool NumberRange::contains(double value) const {
  if (std::isnan(value)) return false;
  if (std::isinf(value)) return never && (value > 0);
  return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

std::string NumberRange::text(Dimension dimension) const {
  const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
  std::string result;
  if (has_low && has_high) {
    result = (low_open ? "above " : "from ") + show_bound(low, dimension) +
             (high_open ? " and below " : " to ") + show_bound(high, dimension);
  } else if (has_low) {
    result = (low_open ? "above " : "at least ") + show_bound(low, dimension);
  } else if (has_high) {
    result = (high_open ? "below " : "at most ") + show_bound(high, dimension);
  }
  if (never) result += (result.empty() ? "" : ", or ") + std::string("math.huge for never");
  return result;
}

std::string NumberRange::wanted(Dimension dimension, bool finite) const {
  std::string result = dimension == dimension::number ? "a number" : describe(dimension);
  if (finite) result = "a finite" + result.substr(result.find(' '));
  if (const std::string limits = text(dimension); !limits.empty()) result += " " + limits;
  if (dimension != dimension::number) result += ", e.g. \"" + example_quantity(dimension) + "\"";
  return result;
}

void check_options(std::span<const OptionRow> rows, const std::any& options, const std::string& of) {
  for (const OptionRow& row : rows) {
    if (!row.words.empty()) continue;
    const std::optional<double> value = row.get(options);
    if (!value || row.range.contains(*value)) continue;
    const std::string unit = si_unit(row.dimension);
    refuse(quoted(row.name) + " of " + of + " is " + format_short(*value) + (unit.empty() ? "" : " " + unit),
           "give " + row.range.wanted(row.dimension, std::isinf(*value)));
  }
}

}  // namespace asperity
