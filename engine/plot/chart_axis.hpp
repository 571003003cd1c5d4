// SPDX-License-Identifier: GPL-3.0-or-later
// An axis of a chart, and how it is laid out: in which prefix unit its values read best, from where to
// where it runs, where its tics stand and what they say. Values are in the unit given (SI as a rule);
// a unit that is not known is printed as it is.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/grid.hpp"

namespace asperity {

struct ChartAxis {
  std::string label;  // "Ra"
  std::string unit;   // "m"; "" for a plain number
  bool logarithmic = false;
  std::optional<Range> range;  // in `unit`; default: the values and a margin
  // Magnitude that chooses the prefix; default: the largest value, on a logarithmic axis the middle.
  std::optional<double> prefix_for;
  int tics = 6;  // about how many, on a linear axis
  // Instead of numbers: the name of value 0, 1, 2, …; the axis is linear and has room for all of them.
  std::vector<std::string> names = {};
};

struct Tic {
  double at;          // in the unit displayed
  std::string label;  // "" for a minor one
};

struct AxisLayout {
  std::string label;         // "Ra (µm)"
  std::string unit;          // "µm"
  double factor = 1;         // divide a value by this to have it in the unit displayed
  double low = 0, high = 1;  // in the unit displayed
  std::vector<Tic> tics;
  bool slanted = false;  // the names need more room along than they have
};

// Lays out an axis for these values, of which non-finite ones, and on a logarithmic axis non-positive
// ones, do not count. With no value left the axis runs from 0 to 1 (1 to 10). `margin` is the share of
// the range left free at each end when no range is given.
AxisLayout lay_out(const ChartAxis& axis, std::span<const double> values, double margin = 0.04);

// Unit text as printed: "um^2" -> "µm²", "N*m" -> "N·m", "deg" -> "°", "MPa/um" -> "MPa/µm".
std::string printed_unit(std::string_view unit);

// The value in its own unit with the prefix that suits it: "20 µm".
std::string printed_quantity(double value, std::string_view unit, int digits = 3);

// Of UTF-8, as printed.
std::size_t characters_of(std::string_view text);
// The first characters of a text that has more than `longest`, and "…".
std::string shortened(std::string_view text, std::size_t longest);

// The greatest of 1, 2, 5 × 10^k that is not above `value` > 0.
double round_below(double value);

}  // namespace asperity
