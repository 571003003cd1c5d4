// SPDX-License-Identifier: GPL-3.0-or-later
// A calibration of a column of a table as it is told and drawn: the text with one line a parameter, the
// chart of the measured rows with the fit and its band, and that of the profile likelihood of each parameter.
// Charts take no further call of the model.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/quantity.hpp"
#include "engine/plot/chart.hpp"
#include "engine/run/notebook_chart.hpp"
#include "engine/statistics/table.hpp"
#include "engine/study/calibration.hpp"

namespace asperity {

struct CalibrationReport {
  Calibration found;
  Table rows;                         // those that were used, in order
  std::vector<std::size_t> numbers;   // of those in the table that was given, from 1
  std::size_t left_out = 0;           // rows without the numbers
  std::string y;                      // the fitted column
  std::vector<Dimension> dimensions;  // of the parameters
  CalibrationScatter scatter = CalibrationScatter::absolute;
  bool known_uncertainty = false;  // rows weigh by `u`
  // Of a curve that was fitted to two columns.
  std::optional<FittedCurve> curve;
  std::optional<double> r_squared;
};

// Several lines without a line end behind the last.
std::string calibration_text(const CalibrationReport& report);
// Of all that was found, without the calls.
std::string calibration_digest(const CalibrationReport& report);

// Measured y, fit and band against a column; without one against the fitted values, with the line on which
// both are alike. Rows that differ in other columns stand as points with bars. Throws Error{unknown_name} for
// a column that is not there, Error{bad_value} for one that is not all numbers.
LineChart calibration_chart(const CalibrationReport& report, const std::optional<std::string>& x);
// (S - S_min)/s² against each parameter with the cut of its interval, a panel each. Throws Error{bad_value}
// where no parameter has a profile.
std::vector<LineChart> likelihood_charts(const CalibrationReport& report);

}  // namespace asperity
