// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/notebook_chart.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

struct Sample {
  double x, y, error;
  double low, high;
};

struct Line {
  Cell value;
  std::vector<Sample> samples;
};

struct Columns {
  std::size_t x;
  std::vector<std::size_t> y;
  std::optional<std::size_t> line, error, low, high;
  std::vector<std::string> names = {};
};

Columns find_columns(const Table& table, const NotebookChart& options) {
  Columns columns;
  columns.x = table.column(options.x, "x");
  if (options.y.empty()) refuse("a chart has no `y`", "name a column");
  for (const std::string& y : options.y) columns.y.push_back(table.column(y, "y"));
  if (options.one_line_per) columns.line = table.column(*options.one_line_per, "one_line_per");
  if (options.spread_column) columns.error = table.column(*options.spread_column, "spread");
  if (options.low) columns.low = table.column(*options.low, "interval");
  if (options.high) columns.high = table.column(*options.high, "interval");
  const std::string& unit = table.columns()[columns.y.front()].unit;
  for (const std::size_t y : columns.y)
    if (table.columns()[y].unit != unit) {
      const auto said = [](const std::string& text) {
        return text.empty() ? "a plain number" : "in " + text;
      };
      throw Error(ErrorCode::bad_unit,
                  "`y` has columns of different units: " + quoted(table.columns()[columns.y.front()].name) +
                      " is " + said(unit) + ", " + quoted(table.columns()[y].name) + " is " +
                      said(table.columns()[y].unit),
                  "draw one chart for each unit");
    }
  return columns;
}

// In order of first rows; empty if the column has a number.
std::vector<std::string> names_along(const Table& table, const std::vector<std::size_t>& rows,
                                     std::size_t column) {
  constexpr std::size_t most = 60;
  std::vector<std::string> names;
  for (const std::size_t row : rows) {
    const Cell& cell = table.cell(row, column);
    if (is_empty(cell)) continue;
    const auto* text = std::get_if<std::string>(&cell);
    if (text == nullptr) return {};
    if (std::ranges::find(names, *text) == names.end()) names.push_back(*text);
  }
  if (names.size() > most)
    refuse(quoted(table.columns()[column].name) + " holds " + std::to_string(names.size()) +
               " different names, and an axis has room for " + std::to_string(most),
           "choose some with `where`, or add a column of numbers");
  return names;
}

std::optional<double> place_of_name(const std::vector<std::string>& names, const Cell& cell) {
  const auto place = std::ranges::find(names, short_text(cell));
  if (place == names.end()) return {};
  return static_cast<double>(place - names.begin());
}

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
    const auto x_number = columns.names.empty() ? number_in(x) : place_of_name(columns.names, x);
    const auto y_number = number_in(y);
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
    const auto end = [&](const std::optional<std::size_t>& column) {
      return column ? number_in(table.cell(row, *column)).value_or(std::nan("")) : *y_number;
    };
    line->samples.push_back({*x_number, *y_number, error, end(columns.low), end(columns.high)});
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

ChartSeries series_of(const Line& line, const NotebookChart& options, bool named) {
  ChartSeries series;
  series.line = options.lines.value_or(options.fits.empty() && !named);
  series.points = options.points;
  const bool ends = options.low.has_value();
  const bool bars = options.spread || options.spread_column.has_value() || ends;
  std::vector<Sample> samples = line.samples;
  if (options.in_order) {
    for (const Sample& sample : samples) {
      series.x.push_back(sample.x);
      series.y.push_back(sample.y);
      if (options.spread_column) series.y_error.push_back(sample.error);
      if (ends) {
        series.y_low.push_back(sample.low);
        series.y_high.push_back(sample.high);
      }
    }
    return series;
  }
  std::ranges::stable_sort(samples, {}, &Sample::x);
  bool averaged = false;
  for (std::size_t k = 0; k < samples.size();) {
    std::vector<double> values, errors, lows, highs;
    std::size_t end = k;
    for (; end < samples.size() && same_cell(samples[end].x, samples[k].x); ++end) {
      values.push_back(samples[end].y);
      errors.push_back(samples[end].error);
      lows.push_back(samples[end].low);
      highs.push_back(samples[end].high);
    }
    const double centre = mean(values);
    series.x.push_back(samples[k].x);
    series.y.push_back(centre);
    if (ends) {
      series.y_low.push_back(mean(lows));
      series.y_high.push_back(mean(highs));
    } else if (bars)
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

double on_axis(const ExpectedValue& value, const TableColumn& column, const std::string& name) {
  if (value.quantity.empty())
    return split_column_unit(name).unit.empty() ? in_unit(value.value, column.unit) : value.value;
  try {
    return parse_quantity_in(value.quantity, column.unit);
  } catch (const Error& error) {
    throw Error(error.code(), "a line across " + quoted(column.name) + ": " + error.sentence(), error.hint());
  }
}

ChartSeries curve_series(std::string name, std::vector<double> x, std::vector<double> y) {
  ChartSeries series;
  series.name = std::move(name);
  series.x = std::move(x);
  series.y = std::move(y);
  series.points = false;
  return series;
}

Range range_along(const LineChart& chart) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  const auto take = [&](double value) {
    if (!std::isfinite(value) || (chart.x.logarithmic && value <= 0)) return;
    range.min = std::min(range.min, value);
    range.max = std::max(range.max, value);
  };
  for (const ChartSeries& series : chart.series)
    for (const double value : series.x) take(value);
  for (const ChartReference& line : chart.references)
    if (line.x) take(*line.x);
  return range;
}

// `y_names`: drawn columns, and the columns they average.
void add_fits(LineChart& chart, const NotebookChart& options, const std::vector<std::string>& y_names) {
  const std::string x_name = split_column_unit(options.x).name;
  for (std::size_t k = 0; k < options.fits.size(); ++k) {
    const FittedCurve& fit = options.fits[k];
    if (fit.x != x_name || std::ranges::find(y_names, fit.y) == y_names.end())
      refuse("`fit` is of " + quoted(fit.y) + " against " + quoted(fit.x) + ", and the chart shows " +
                 quoted(joined(y_names, ", ")) + " against " + quoted(x_name),
             "draw the columns that were fitted");
    std::vector<double> x, y, low, high;
    for (const CurvePoint& point : fit.curve) {
      x.push_back(in_unit(point.x, chart.x.unit));
      y.push_back(in_unit(point.y, chart.y.unit));
      low.push_back(in_unit(point.low, chart.y.unit));
      high.push_back(in_unit(point.high, chart.y.unit));
    }
    std::string name = fit.name;
    if (name.empty()) name = options.fits.size() > 1 ? "fit " + std::to_string(k + 1) : "fit";
    name += ", " + format_short(100 * fit.confidence, 4) + " % band";
    ChartSeries series = curve_series(std::move(name), std::move(x), std::move(y));
    series.y_low = std::move(low);
    series.y_high = std::move(high);
    series.band = true;
    chart.series.push_back(std::move(series));
  }
}

void add_functions(LineChart& chart, const NotebookChart& options) {
  if (options.functions.empty()) return;
  const Range range = range_along(chart);
  constexpr int steps = 300;
  for (const FunctionLine& function : options.functions) {
    std::vector<double> x, y;
    for (int k = 0; k <= steps && range.min <= range.max; ++k) {
      const double share = static_cast<double>(k) / steps;
      const double at = chart.x.logarithmic ? range.min * elementary::pow(range.max / range.min, share)
                                            : range.min * (1 - share) + range.max * share;
      x.push_back(std::clamp(at, range.min, range.max));
      y.push_back(in_unit(function.value(from_unit(x.back(), chart.x.unit)), chart.y.unit));
    }
    chart.series.push_back(curve_series(function.name, std::move(x), std::move(y)));
  }
}

[[noreturn]] void refuse_empty(const Table& table, const std::vector<std::size_t>& rows,
                               const NotebookChart& options, const Unreadable& unreadable,
                               const std::string& y, const std::string& x) {
  std::string hint = table.name() + " has no rows";
  if (table.rows() > 0)
    hint = rows.empty() ? "no row matches `where` " + options.where.text()
                        : "none of the " + std::to_string(rows.size()) + " rows has a number in both";
  if (!rows.empty() && unreadable.rows > 0)
    hint = quoted(unreadable.column) + " holds names, such as \"" + unreadable.text +
           "\"; names can only be along x: add a column of numbers";
  refuse("the chart of " + quoted(y) + " against " + quoted(x) + " has nothing to draw", hint);
}

// With units: all along y have that of the first, if dimensions are equal.
std::vector<std::string> units_of_axes(const Table& table, const NotebookChart& options) {
  std::vector<std::string> named = {options.x};
  if (options.one_line_per) named.push_back(*options.one_line_per);
  std::vector<std::string> up = options.y;
  for (const auto& column : {options.spread_column, options.low, options.high})
    if (column) up.push_back(*column);
  if (up.empty()) return named;
  const std::string unit = table.display_unit_of(up.front(), table.column(up.front(), "y"));
  for (const std::string& name : up) {
    const auto k = table.find_column(name);
    const std::string& own = k ? table.columns()[*k].unit : unit;
    const bool alike = k && (own.empty() || parse_unit(own).dimension == parse_unit(unit).dimension);
    if (alike && !unit.empty()) named.push_back(split_column_unit(name).name + " [" + unit + "]");
  }
  return named;
}

}  // namespace

LineChart chart_of(const Table& given, const NotebookChart& options, std::vector<std::string>& warnings) {
  const Table table = in_display_units(given, units_of_axes(given, options));
  Columns columns = find_columns(table, options);
  const std::vector<std::size_t> rows = options.where.rows(given);
  columns.names = names_along(table, rows, columns.x);
  if (!columns.names.empty() && (options.log_x || !options.fits.empty() || !options.functions.empty()))
    refuse(quoted(options.x) + " holds names, such as \"" + columns.names.front() + "\"",
           "`log_x`, `fit` and `functions` need numbers along");
  LineChart chart;
  chart.title = options.title;
  const TableColumn& x = table.columns()[columns.x];
  const TableColumn& y = table.columns()[columns.y.front()];
  std::vector<std::string> names, fitted;
  for (const std::size_t k : columns.y) {
    names.push_back(table.columns()[k].name);
    fitted.push_back(names.back());
    if (!table.columns()[k].mean_of.empty()) fitted.push_back(table.columns()[k].mean_of);
  }
  chart.x.label = options.x_label.value_or(x.name);
  chart.x.unit = x.unit;
  chart.x.logarithmic = options.log_x;
  chart.x.names = columns.names;
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
      chart.series.push_back(series_of(line, options, !columns.names.empty()));
      chart.series.back().name = line_name(options, names[k], line, table, columns);
    }
  if (unreadable.rows > 0)
    warnings.push_back(std::to_string(unreadable.rows) + (unreadable.rows == 1 ? " row is" : " rows are") +
                       " not drawn: text where a number should be");
  if (drawn == 0) refuse_empty(table, rows, options, unreadable, joined(names, ", "), x.name);
  for (const ReferenceLine& line : options.references) {
    ChartReference across;
    across.name = line.name;
    if (line.x) across.x = on_axis(*line.x, x, options.x);
    if (line.y) across.y = on_axis(*line.y, y, options.y.front());
    chart.references.push_back(std::move(across));
  }
  const bool named =
      !options.fits.empty() || !options.functions.empty() ||
      std::ranges::any_of(options.references, [](const auto& line) { return !line.name.empty(); });
  if (named && chart.series.size() == 1 && chart.series.front().name.empty()) {
    const std::string& mean_of = table.columns()[columns.y.front()].mean_of;
    chart.series.front().name = mean_of.empty() ? names.front() : "mean of " + mean_of;
  }
  add_fits(chart, options, fitted);
  add_functions(chart, options);
  chart.legend = options.legend;
  if (options.width || options.font_size)
    print_at(chart, options.width.value_or(0.24), options.font_size.value_or(8));
  return chart;
}

std::string default_chart_file(std::string_view notebook, const NotebookChart& options) {
  std::string name(notebook);
  for (const std::string& y : options.y) name += "-" + split_column_unit(y).name;
  return safe_file_name(name + "-" + split_column_unit(options.x).name) + ".svg";
}

void note_chart(RunDirectory& run, std::string_view name, const NotebookChart& options,
                const std::vector<std::string>& warnings) {
  Json where = Json::object();
  for (const Condition& condition : options.where.conditions()) {
    Json::List accepted;
    for (const Cell& cell : condition.accepted) accepted.push_back(to_json(cell));
    where.set(split_column_unit(condition.column).name, std::move(accepted));
  }
  Json fields =
      Json::object({{"notebook", name}, {"file", options.file.value_or(default_chart_file(name, options))}});
  if (!warnings.empty()) fields.set("warnings", Json::strings(warnings));
  fields.set("unhashed", Json::object({{"x", options.x},
                                       {"y", Json::strings(options.y)},
                                       {"per", options.one_line_per.value_or("")},
                                       {"log_x", options.log_x},
                                       {"log_y", options.log_y},
                                       {"title", options.title},
                                       {"x_label", options.x_label.value_or("")},
                                       {"y_label", options.y_label.value_or("")},
                                       {"where", std::move(where)},
                                       {"points", options.points},
                                       {"spread", options.spread}}));
  run.journal().write("chart", fields);
}

DrawnChart draw_chart(RunDirectory& run, std::string_view name, const Table& table,
                      const NotebookChart& options) {
  const std::string file = options.file.value_or(default_chart_file(name, options));
  const PictureFormat format = picture_format(file);
  DrawnChart drawn;
  std::vector<LineChart> panels = {chart_of(table, options, drawn.warnings)};
  for (const NotebookChart* next = options.below.get(); next != nullptr; next = next->below.get()) {
    NotebookChart panel = *next;
    panel.width = options.width;
    panel.font_size = options.font_size;
    panels.push_back(chart_of(table, panel, drawn.warnings));
  }
  drawn.file = run.path_for(file);
  if (run.dry()) {
    chart_script(panels, format, drawn.warnings);
    return drawn;
  }
  const std::vector<std::string> more = draw(panels, drawn.file);
  drawn.warnings.insert(drawn.warnings.end(), more.begin(), more.end());
  note_chart(run, name, options, drawn.warnings);
  return drawn;
}

DrawnChart draw_chart(RunDirectory& run, const Notebook& notebook, const NotebookChart& options) {
  return draw_chart(run, notebook.name(), notebook.table(), options);
}

}  // namespace asperity
