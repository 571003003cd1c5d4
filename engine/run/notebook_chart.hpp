// SPDX-License-Identifier: GPL-3.0-or-later
// The chart of a notebook or table: columns against a column, one line per value of another column. Rows with
// equal line and x are averaged. With `spread`, means carry error bars (standard deviation with n-1, or mean
// errors); otherwise rows are faint points. `in_order` joins the rows as written. Texts give an axis of
// names.
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
#include "engine/statistics/table_operations.hpp"

namespace asperity {

// In SI. Confidence interval of the curve, not of a measurement.
struct CurvePoint {
  double x = 0, y = 0, low = 0, high = 0;
};

// Its columns must be those of the chart.
struct FittedCurve {
  std::string name;
  std::string x, y;
  double confidence = 0.95;
  std::vector<CurvePoint> curve;
};

struct FunctionLine {
  std::string name;
  std::function<double(double x)> value;  // in SI
};

// In SI, in the unit of the name in `x` and `y`, or a quantity.
struct ReferenceLine {
  std::optional<ExpectedValue> x, y;
  std::string name;
};

struct NotebookChart {
  std::string x;                            // its unit is the axis's
  std::vector<std::string> y;               // of one unit
  std::optional<std::string> one_line_per;  // a column; ascending values
  bool spread = false;                      // standard deviations
  std::optional<std::string> spread_column;
  TableFilter where;
  bool log_x = false, log_y = false;
  bool in_order = false;
  std::optional<bool> lines;  // default: unless fits or names
  bool points = true;
  std::string title;
  std::optional<std::string> x_label, y_label;  // units are added
  std::optional<std::string> file;              // default_chart_file()
  std::optional<double> width;                  // m, as printed
  std::optional<double> font_size;              // points, with `width`; default 8
  std::string legend = {};                      // as LineChart's
  std::optional<std::string> low, high;         // columns: ends of error bars
  std::vector<ReferenceLine> references;
  std::vector<FittedCurve> fits;
  std::vector<FunctionLine> functions;
  std::shared_ptr<NotebookChart> below;  // second panel
};

// `warnings`: cells without numbers. Throws Error{unknown_name} for a missing column, Error{bad_unit} for y
// columns of different units, Error{bad_value} if no row has x and y.
LineChart chart_of(const Table& table, const NotebookChart& options, std::vector<std::string>& warnings);

// "<notebook>-<y>-<x>.svg"
std::string default_chart_file(std::string_view notebook, const NotebookChart& options);

// Journal event "chart"; in a dry run, for the journal's watcher only.
void note_chart(RunDirectory& run, std::string_view name, const NotebookChart& options,
                const std::vector<std::string>& warnings);

struct DrawnChart {
  std::filesystem::path file;
  std::vector<std::string> warnings;
};

// Journal event "chart". A dry run only checks. Throws as chart_of, RunDirectory::path_for and draw do.
DrawnChart draw_chart(RunDirectory& run, const Notebook& notebook, const NotebookChart& options);
DrawnChart draw_chart(RunDirectory& run, std::string_view name, const Table& table,
                      const NotebookChart& options);

}  // namespace asperity
