// SPDX-License-Identifier: GPL-3.0-or-later
// The chart of a notebook: columns against a column, one line for each value of another. Rows that
// share line and x are averaged, and drawn as means; with `spread` the means carry error bars (the
// standard deviation of those rows, n-1, or the mean of a column that holds errors), without it the
// single rows stand as faint points behind. `in_order` joins the rows as they were written instead, for
// loops that come back (load and unload).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/plot/chart.hpp"
#include "engine/run/notebook.hpp"
#include "engine/run/run_directory.hpp"
#include "engine/statistics/table.hpp"
#include "engine/statistics/table_filter.hpp"

namespace asperity {

struct NotebookChart {
  std::string x;
  std::vector<std::string> y;                // one or more columns of one unit
  std::optional<std::string> one_line_per;   // a column; its values in ascending order
  bool spread = false;                       // error bars from the scatter of rows
  std::optional<std::string> spread_column;  // error bars from this column
  TableFilter where;
  bool log_x = false, log_y = false;
  bool in_order = false;
  bool lines = true, points = true;
  std::string title;
  std::optional<std::string> x_label, y_label;  // instead of the columns' names; units are added
  std::optional<std::string> file;              // default <notebook>-<y>-<x>.svg
};

// The lines of the chart; `warnings` gets sentences about cells that are not numbers. Throws
// Error{unknown_name} for a missing column, naming the key and the nearest one; Error{bad_unit} for y
// columns of different units; Error{bad_value} when no row has x and y.
LineChart chart_of(const Table& table, const NotebookChart& options, std::vector<std::string>& warnings);

// "<notebook>-<y>-<x>.svg", safe as a file name.
std::string default_chart_file(std::string_view notebook, const NotebookChart& options);

struct DrawnChart {
  std::filesystem::path file;
  std::vector<std::string> warnings;
};

// Draws the chart of what the notebook holds now under the run's directory; journal event "chart".
// A dry run checks everything and draws nothing. Throws as chart_of, RunDirectory::path_for and
// draw do.
DrawnChart draw_chart(RunDirectory& run, const Notebook& notebook, const NotebookChart& options);

}  // namespace asperity
