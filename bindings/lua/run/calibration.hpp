// SPDX-License-Identifier: GPL-3.0-or-later
// The common part of t:fit and lab.calibrate: keys, reading of rows, and a calibration as a native value with
// its fields and charts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "engine/statistics/table_filter.hpp"
#include "engine/study/calibration_report.hpp"

namespace asperity::lua {

struct CalibrationKeys {
  std::string y;
  std::optional<std::string> x, weights;
  std::optional<double> u_number;
  std::optional<std::string> u_text;  // a column, or a quantity
  std::optional<std::string> specimen;
  TableFilter where;
  CalibrationOptions options;
};

Option<CalibrationKeys> u_option();
Option<CalibrationKeys> scatter_option();
Option<CalibrationKeys> specimen_option();
Option<CalibrationKeys> basis_option();
Option<CalibrationKeys> confidence_option();
Option<CalibrationKeys> profile_option();

struct CalibrationInput {
  CalibrationRows rows;
  Table used;                        // the table of these rows
  std::vector<std::size_t> numbers;  // of these rows after `where`, from 1
  std::size_t left_out = 0;
};

// The rows with a number in each named column, a specimen where one is named, and a weight above 0. Throws as
// number_columns() does, Error{bad_value} besides where no row matches `where` and for a weight below 0.
CalibrationInput calibration_input(const Table& table, const CalibrationKeys& keys);

// A calibration with its rows; shows the warnings, and warns of a column of specimens without a key.
CalibrationReport calibration_report(Call& call, const CalibrationKeys& keys, CalibrationInput input,
                                     Calibration found);

template <>
const Class& class_of<CalibrationReport>();

}  // namespace asperity::lua
