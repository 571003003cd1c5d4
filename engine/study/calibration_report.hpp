// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/quantity.hpp"
#include "engine/plot/chart.hpp"
#include "engine/run/notebook_chart.hpp"
#include "engine/statistics/table.hpp"
#include "engine/study/calibrate.hpp"

namespace asperity {

struct CalibrationReport {
  Calibration found;
  Table rows;                        // used rows
  std::vector<std::size_t> numbers;  // in the given table, from 1
  std::size_t left_out = 0;          // rows without numbers
  std::string y;
  std::vector<Dimension> dimensions;
  std::vector<std::string> units = {};  // of a line's parameters; else by dimension
  CalibrationScatter scatter = CalibrationScatter::absolute;
  bool known_uncertainty = false;  // rows are weighted by `u`
  // For a curve through two columns.
  std::optional<FittedCurve> curve;
  std::optional<double> r_squared;
};

std::string calibration_text(const CalibrationReport& report);
// Without the number of calls.
std::string calibration_digest(const CalibrationReport& report);

// Measured y, fit and band against a column, or against fitted values. Points with bars if rows depend on
// other columns. Throws Error{unknown_name} for a missing column, Error{bad_value} for text.
LineChart calibration_chart(const CalibrationReport& report, const std::optional<std::string>& x);
// (S - S_min)/s² against each parameter, with the cut. Throws Error{bad_value} without any profile.
std::vector<LineChart> likelihood_charts(const CalibrationReport& report);

}  // namespace asperity
