// SPDX-License-Identifier: GPL-3.0-or-later
// The chart of a notebook or of a table: columns against a column, one line for each value of another. Rows
// that share line and x are averaged, and drawn as means; with `spread` the means carry error bars (the
// standard deviation of those rows, n-1, or the mean of a column that holds errors), without it the
// single rows stand as faint points behind. `in_order` joins the rows as they were written instead, for
// loops that come back (load and unload). A column of texts along x gives an axis of names, in the order of
// their first rows. Fits of the same columns are drawn with their bands, functions as lines over the range of
// x, and lines across at one x or y; a second chart stands below.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/plot/chart.hpp"
#include "engine/run/expectation.hpp"
#include "engine/run/notebook.hpp"
#include "engine/run/run_directory.hpp"
#include "engine/statistics/table.hpp"
#include "engine/statistics/table_filter.hpp"

namespace asperity {

// The curve at one x with the interval of the curve (not of a further measurement) there.
struct CurvePoint {
  double x = 0, y = 0, low = 0, high = 0;
};

// A fitted curve as it is drawn. Its columns must be those of the chart.
struct FittedCurve {
  std::string name;
  std::string x, y;
  double confidence = 0.95;
  std::vector<CurvePoint> curve;
};

// A function of x, in the units of the columns.
struct FunctionLine {
  std::string name;
  std::function<double(double x)> value;
};

// A line across at one x or one y: a number in the column's unit, or a quantity, which is converted to it.
struct ReferenceLine {
  std::optional<ExpectedValue> x, y;
  std::string name;
};

struct NotebookChart {
  std::string x;
  std::vector<std::string> y;                // one or more columns of one unit
  std::optional<std::string> one_line_per;   // a column; its values in ascending order
  bool spread = false;                       // error bars from the scatter of rows
  std::optional<std::string> spread_column;  // error bars from this column
  TableFilter where;
  bool log_x = false, log_y = false;
  bool in_order = false;
  std::optional<bool> lines;  // default: where no fit is drawn and x is no axis of names
  bool points = true;
  std::string title;
  std::optional<std::string> x_label, y_label;  // instead of the columns' names; units are added
  std::optional<std::string> file;              // default <notebook>-<y>-<x>.svg
  std::optional<std::string> low, high;         // columns that hold the ends of error bars
  std::vector<ReferenceLine> references;
  std::vector<FittedCurve> fits;
  std::vector<FunctionLine> functions;
  std::shared_ptr<NotebookChart> below;  // a second panel
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
// The same of a table, which the journal and the default file call `name`.
DrawnChart draw_chart(RunDirectory& run, std::string_view name, const Table& table,
                      const NotebookChart& options);

}  // namespace asperity
