// SPDX-License-Identifier: GPL-3.0-or-later
// Common to t:fit and lab.calibrate: keys, selection of rows, class.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "engine/statistics/table_operations.hpp"
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
  Table used;                        // the selected rows
  std::vector<std::size_t> numbers;  // after `where`, from 1
  std::size_t left_out = 0;
};

// Selects rows with a number in each named column, a named specimen, and a weight above 0. Throws as
// number_columns(), and Error{bad_value} for a negative weight or if no row matches `where`.
CalibrationInput calibration_input(const Table& table, const CalibrationKeys& keys);

// Warns of a column of specimens without a key.
CalibrationReport calibration_report(Call& call, const CalibrationKeys& keys, CalibrationInput input,
                                     Calibration found);

Class make_class(For<CalibrationReport>);

}  // namespace asperity::lua
