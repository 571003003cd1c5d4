// SPDX-License-Identifier: GPL-3.0-or-later
// Axis layout: prefix unit, range, tics. Values are in the given unit, usually SI; unknown units are printed
// as given.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/grid.hpp"

namespace asperity {

struct ChartAxis {
  std::string label;
  std::string unit;  // "" for plain numbers
  bool logarithmic = false;
  std::optional<Range> range;  // in `unit`; default: the values and a margin
  // Magnitude for the prefix; default: largest value, logarithmic: geometric mean.
  std::optional<double> prefix_for;
  int tics = 6;  // approximate number on a linear axis
  // Names of values 0, 1, 2, …; linear axis with room for all.
  std::vector<std::string> names = {};
  double names_room = 620;  // pixels, with text of 16 points
};

struct Tic {
  double at;          // in the displayed unit
  std::string label;  // "" for a minor tic
};

struct AxisLayout {
  std::string label;         // "Ra (µm)"
  std::string unit;          // "µm"
  double factor = 1;         // value / factor is in the displayed unit
  double low = 0, high = 1;  // in the displayed unit
  std::vector<Tic> tics;
  bool slanted = false;  // names too long for horizontal text
};

// Ignores values that cannot be drawn. Without values: 0 to 1 (logarithmic: 1 to 10). `margin`: free share of
// the range at each end, without a given `range`.
AxisLayout lay_out(const ChartAxis& axis, std::span<const double> values, double margin = 0.04);

// "um^2" -> "µm²", "N*m" -> "N·m", "deg" -> "°", "MPa/um" -> "MPa/µm".
std::string printed_unit(std::string_view unit);

// With a suitable prefix: "20 µm".
std::string printed_quantity(double value, std::string_view unit, int digits = 3);

// Cuts to `longest` characters and appends "…".
std::string shortened(std::string_view text, std::size_t longest);

// Greatest 1, 2 or 5 × 10^k up to `value` > 0.
double round_below(double value);

}  // namespace asperity
