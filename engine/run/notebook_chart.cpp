// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/notebook_chart.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/core/error.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

struct Sample {
  double x, y, error;
};

// Numbers first in ascending order, then booleans and text.
bool comes_before(const Cell& a, const Cell& b) {
  if (a.index() != b.index()) return a.index() < b.index();
  return a < b;
}

struct Line {
  Cell value;  // of `one_line_per`
  std::vector<Sample> samples;
};

// The columns a chart reads, found once.
struct Columns {
  std::size_t x;
  std::vector<std::size_t> y;
  std::optional<std::size_t> line, error;
};

Columns find_columns(const Table& table, const NotebookChart& options) {
  Columns columns;
  columns.x = table.column(options.x, "x");
  if (options.y.empty()) throw Error(ErrorCode::bad_value, "a chart has no `y`", "name a column");
  for (const std::string& y : options.y) columns.y.push_back(table.column(y, "y"));
  if (options.one_line_per) columns.line = table.column(*options.one_line_per, "one_line_per");
  if (options.spread_column) columns.error = table.column(*options.spread_column, "spread");
  const std::string& unit = table.columns()[columns.y.front()].unit;
  for (const std::size_t y : columns.y)
    if (table.columns()[y].unit != unit) {
      const auto said = [](const std::string& text) {
        return text.empty() ? "a plain number" : "in " + text;
      };
      throw Error(ErrorCode::bad_unit,
                  "`y` has columns of different units: " +
                      asperity::quoted(table.columns()[columns.y.front()].name) + " is " + said(unit) + ", " +
                      asperity::quoted(table.columns()[y].name) + " is " + said(table.columns()[y].unit),
                  "draw one chart for each unit");
    }
  return columns;
}

// Rows that hold text where a number should be, and the first of it.
struct Unreadable {
  std::size_t rows = 0;
  std::string column, text;
};

std::vector<Line> lines_of(const Table& table, const std::vector<std::size_t>& rows, const Columns& columns,
                           std::size_t y_column, Unreadable& unreadable) {
  std::vector<Line> lines;
  if (!columns.line) lines.push_back({});
  for (const std::size_t row : rows) {
    const Cell& x = table.cell(row, columns.x);
    const Cell& y = table.cell(row, y_column);
    if (is_empty(x) || is_empty(y)) continue;
    const auto x_number = number_in(x), y_number = number_in(y);
    if (!x_number || !y_number) {
      const std::size_t column = x_number ? y_column : columns.x;
      if (unreadable.rows++ == 0) {
        unreadable.column = table.columns()[column].name;
        unreadable.text = short_text(table.cell(row, column));
      }
      continue;
    }
    const Cell value = columns.line ? table.cell(row, *columns.line) : Cell();
    auto line = std::ranges::find_if(lines, [&](const Line& known) { return same_cell(known.value, value); });
    if (line == lines.end()) line = lines.insert(lines.end(), {value, {}});
    const double error = columns.error ? number_in(table.cell(row, *columns.error)).value_or(0) : 0;
    line->samples.push_back({*x_number, *y_number, error});
  }
  if (columns.line)
    std::ranges::stable_sort(lines,
                             [](const Line& a, const Line& b) { return comes_before(a.value, b.value); });
  return lines;
}

double standard_deviation(const std::vector<double>& values, double centre) {
  if (values.size() < 2) return 0;
  double sum = 0;
  for (const double value : values) sum += (value - centre) * (value - centre);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

ChartSeries series_of(const Line& line, const NotebookChart& options) {
  ChartSeries series;
  series.line = options.lines;
  series.points = options.points;
  const bool bars = options.spread || options.spread_column.has_value();
  std::vector<Sample> samples = line.samples;
  if (options.in_order) {
    for (const Sample& sample : samples) {
      series.x.push_back(sample.x);
      series.y.push_back(sample.y);
      if (options.spread_column) series.y_error.push_back(sample.error);
    }
    return series;
  }
  std::ranges::stable_sort(samples, {}, &Sample::x);
  bool averaged = false;
  for (std::size_t k = 0; k < samples.size();) {
    std::vector<double> values, errors;
    std::size_t end = k;
    for (; end < samples.size() && same_cell(samples[end].x, samples[k].x); ++end) {
      values.push_back(samples[end].y);
      errors.push_back(samples[end].error);
    }
    const double centre = mean(values);
    series.x.push_back(samples[k].x);
    series.y.push_back(centre);
    if (bars)
      series.y_error.push_back(options.spread_column ? mean(errors) : standard_deviation(values, centre));
    averaged |= values.size() > 1;
    k = end;
  }
  if (averaged && !bars)
    for (const Sample& sample : samples) {
      series.cloud_x.push_back(sample.x);
      series.cloud_y.push_back(sample.y);
    }
  return series;
}

std::string line_name(const NotebookChart& options, const std::string& y, const Line& line,
                      const Table& table, const Columns& columns) {
  std::string name = options.y.size() > 1 ? y : "";
  if (!columns.line) return name;
  const std::optional<double> number = is_number(line.value) ? number_in(line.value) : std::nullopt;
  const std::string& unit = table.columns()[*columns.line].unit;
  if (!name.empty()) name += ", ";
  return name + (number && !unit.empty() ? printed_quantity(*number, unit, 4) : short_text(line.value));
}

}  // namespace

LineChart chart_of(const Table& table, const NotebookChart& options, std::vector<std::string>& warnings) {
  const Columns columns = find_columns(table, options);
  const std::vector<std::size_t> rows = options.where.rows(table);
  LineChart chart;
  chart.title = options.title;
  const TableColumn& x = table.columns()[columns.x];
  const TableColumn& y = table.columns()[columns.y.front()];
  std::vector<std::string> names;
  for (const std::size_t k : columns.y) names.push_back(table.columns()[k].name);
  chart.x.label = options.x_label.value_or(x.name);
  chart.x.unit = x.unit;
  chart.x.logarithmic = options.log_x;
  chart.y.label = options.y_label.value_or(joined(names, ", "));
  chart.y.unit = y.unit;
  chart.y.logarithmic = options.log_y;
  if (columns.line) chart.key_title = table.columns()[*columns.line].name;

  Unreadable unreadable;
  std::size_t drawn = 0;
  for (std::size_t k = 0; k < columns.y.size(); ++k)
    for (const Line& line : lines_of(table, rows, columns, columns.y[k], unreadable)) {
      if (line.samples.empty()) continue;
      drawn += line.samples.size();
      chart.series.push_back(series_of(line, options));
      chart.series.back().name = line_name(options, names[k], line, table, columns);
    }
  if (unreadable.rows > 0)
    warnings.push_back(std::to_string(unreadable.rows) + (unreadable.rows == 1 ? " row is" : " rows are") +
                       " not drawn: text where a number should be");
  if (drawn == 0) {
    std::string hint = "the notebook has no rows";
    if (table.rows() > 0)
      hint = rows.empty() ? "no row matches `where` " + options.where.text()
                          : "none of the " + std::to_string(rows.size()) + " rows has a number in both";
    if (!rows.empty() && unreadable.rows > 0)
      hint = asperity::quoted(unreadable.column) + " holds names, such as \"" + unreadable.text +
             "\"; an axis takes numbers: give `one_line_per` the names, or write a column of numbers beside "
             "them";
    throw Error(ErrorCode::bad_value,
                "the chart of " + asperity::quoted(joined(names, ", ")) + " against " +
                    asperity::quoted(x.name) + " has nothing to draw",
                hint);
  }
  return chart;
}

std::string default_chart_file(std::string_view notebook, const NotebookChart& options) {
  std::string name(notebook);
  for (const std::string& y : options.y) name += "-" + y;
  return safe_file_name(name + "-" + options.x) + ".svg";
}

DrawnChart draw_chart(RunDirectory& run, const Notebook& notebook, const NotebookChart& options) {
  const std::string file = options.file.value_or(default_chart_file(notebook.name(), options));
  const PictureFormat format = picture_format(file);
  DrawnChart drawn;
  const LineChart chart = chart_of(notebook.table(), options, drawn.warnings);
  drawn.file = run.path_for(file);
  if (run.dry()) {
    chart_script(chart, format, drawn.warnings);
    return drawn;
  }
  const std::vector<std::string> more = draw(chart, drawn.file);
  drawn.warnings.insert(drawn.warnings.end(), more.begin(), more.end());
  Json fields = Json::object({{"notebook", notebook.name()}, {"file", file}});
  if (!drawn.warnings.empty()) fields.set("warnings", Json::strings(drawn.warnings));
  run.journal().write("chart", fields);
  return drawn;
}

}  // namespace asperity
