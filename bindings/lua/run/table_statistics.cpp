// SPDX-License-Identifier: GPL-3.0-or-later
// t:mean (with intervals) and t:histogram.
#include <algorithm>

#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/run.hpp"
#include "bindings/lua/run/table_values.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "engine/core/require.hpp"
#include "engine/run/run_directory.hpp"
#include "engine/statistics/histogram.hpp"
#include "engine/statistics/sample_mean.hpp"
#include "engine/statistics/table_operations.hpp"

namespace asperity::lua {

namespace {

using Rows = asperity::Table;

struct MeanKeys {
  std::vector<std::string> by;
  TableFilter where;
  double confidence = 0.95;
  MeanInterval interval = MeanInterval::student;
};

const Block<MeanKeys> mean_block{
    {texts_key("by", "string|string[]", "a column, or columns: one mean for the rows that are equal in them",
               &MeanKeys::by),
     where_key(&MeanKeys::where),
     number("confidence", &MeanKeys::confidence, inside(0, 1),
            "the share of such intervals that hold the mean"),
     choice("interval", &MeanKeys::interval,
            {{"student", MeanInterval::student}, {"log", MeanInterval::log_normal}},
            "Student's t; or, for values above 0 that are clearly skewed, the log interval of Cox, which "
            "assumes that their logarithms are normal")}};

Cell cell_of_number(const std::optional<double>& number) {
  return number && std::isfinite(*number) ? Cell(*number) : Cell();
}

std::vector<TableColumn> mean_columns(const Rows& table, const MeanKeys& keys, const std::string& column,
                                      const std::string& unit) {
  const TableColumn& averaged = table.columns()[table.column(column, "column")];
  std::vector<TableColumn> columns, found = {{"mean", unit, averaged.name, averaged.plain}};
  for (const char* name : {"sd", "u", "low", "high"}) found.push_back({name, unit, {}, averaged.plain});
  for (const char* name : {"n", "left_out", "skewness", "interval"}) found.push_back({name, {}, {}, true});
  for (const std::string& name : keys.by) {
    columns.push_back(table.columns()[table.column(name, "by")]);
    for (const TableColumn& other : found)
      if (other.name == columns.back().name)
        refuse("`by` names the column " + quoted(other.name) + ", and the means have one of that name",
               "give the column of the rows another name");
  }
  columns.insert(columns.end(), found.begin(), found.end());
  return columns;
}

// One warning per kind: first group, number of groups.
void warn_of_groups(Call& call, const std::string& column, const MeanKeys& keys,
                    const std::vector<GroupMean>& groups) {
  struct Told {
    std::string kind, where, warning;
    std::size_t count = 0;
  };
  std::vector<Told> told;
  for (const GroupMean& group : groups)
    for (const std::string& warning : group.of.warnings) {
      const std::string kind = kind_of_warning(warning);
      auto found = std::ranges::find(told, kind, &Told::kind);
      if (found == told.end()) {
        std::string where;
        for (std::size_t k = 0; k < keys.by.size(); ++k)
          where += (k == 0 ? " where " : " and ") + quoted(keys.by[k]) + " = " + short_text(group.by[k]);
        found = told.insert(told.end(), {kind, where, warning});
      }
      ++found->count;
    }
  for (const Told& of : told)
    call.session().monitor().warn("column " + quoted(column) + of.where +
                                  (of.count > 1 ? ", and in " + std::to_string(of.count - 1) + " more of " +
                                                      std::to_string(groups.size()) + " groups"
                                                : "") +
                                  ": " + of.warning);
}

Values mean_of_column(Call& call) {
  const MeanKeys keys = call.options(mean_block, 2);
  const auto whole = table_of_self(call);
  const std::string column = call.text(1, "column");
  const Rows table = rows_of(*whole, keys.where.rows(*whole));
  const std::string unit = table.display_unit_of(column, table.column(column, "column"));
  std::vector<TableColumn> columns = mean_columns(table, keys, column, unit);
  const std::vector<GroupMean> groups = means_of(table, column, keys.by, keys.interval, keys.confidence);
  std::vector<std::vector<Cell>> rows;
  for (const GroupMean& group : groups) {
    const SampleMean& of = group.of;
    std::vector<Cell> row = group.by;
    for (const auto& number : {of.count > 0 ? std::optional(of.mean) : std::nullopt, of.deviation,
                               of.standard_error, of.low, of.high})
      row.push_back(cell_of_number(number));
    row.emplace_back(static_cast<std::int64_t>(of.count));
    row.emplace_back(static_cast<std::int64_t>(of.left_out));
    row.push_back(cell_of_number(of.skewness));
    row.emplace_back(of.method);
    rows.push_back(std::move(row));
  }
  warn_of_groups(call, column, keys, groups);
  Rows means(std::move(columns), std::move(rows));
  means.rename("the means of " + quoted(split_column_unit(column).name) + "; low to high is their " +
               format_short(100 * keys.confidence, 4) + " % interval");
  return {object(std::move(means))};
}

struct HistogramKeys {
  TableFilter where;
  std::optional<int> count;
  std::vector<ExpectedValue> edges;
  bool density = false;
  std::string title;
  std::optional<std::string> x_label, file;
};

void read_bins(const Argument& value, const OptionInfo& info, HistogramKeys& keys, Problems& problems) {
  if (value.is_number()) {
    if (auto bins = detail::read_integer(value, info, between(1, 10'000), problems))
      keys.count = static_cast<int>(*bins);
    return;
  }
  if (!value.is_table() || value.length() == 0)
    return detail::wrong_type(value, info, "a whole number of bins, or a list of their edges", problems);
  value.elements([&](const Argument& edge) {
    if (edge.is_number())
      keys.edges.emplace_back(edge.number());
    else if (edge.is_text())
      detail::collect(
          problems, [&] { keys.edges.emplace_back(edge.text()); }, info.name);
    else if (!edge.is_unknown())
      detail::wrong_type(edge, info, "an edge: a number or a quantity", problems);
  });
}

const Block<HistogramKeys> column_histogram_block{
    {custom<HistogramKeys>("bins", "integer|number[]",
                           "how many bins of equal width, or a list of their edges: quantities, or numbers "
                           "in SI or in the unit of the column's name",
                           read_bins)
         .defaults_to("by the rule of Freedman and Diaconis"),
     where_key(&HistogramKeys::where),
     flag("density", &HistogramKeys::density, "draw the share of values per width instead of their number"),
     text("title", &HistogramKeys::title, "above the picture"),
     text("x_label", &HistogramKeys::x_label, "instead of the column's name"),
     text("file", &HistogramKeys::file, "draws it: an .svg, .png or .pdf under the run directory")}};

const RecordType<ValueHistogram> histogram_record{
    "Histogram",
    "histogram",
    "Counts of the values of a column in bins.",
    {{"edges", &ValueHistogram::edges, "of the bins in SI, one more than bins; a bin holds its lower edge"},
     {"counts",
      [](const ValueHistogram& h) { return std::vector<std::int64_t>(h.counts.begin(), h.counts.end()); },
      "values in each bin"},
     {"density", &ValueHistogram::density, "share of the values per width of each bin"},
     {"n", &ValueHistogram::values, "values in the bins"},
     {"below", &ValueHistogram::below, "values below the first edge"},
     {"above", &ValueHistogram::above, "values above the last edge"},
     {"left_out", &ValueHistogram::left_out, "cells that are empty or no finite number"},
     {"rule", &ValueHistogram::rule, "by which the bins were chosen"}}};

// In the unit of `column`.
void draw_histogram(Call& call, const HistogramKeys& keys, const TableColumn& column,
                    const ValueHistogram& found) {
  const double width = from_unit(1, column.unit);
  LineChart chart;
  chart.title = keys.title;
  chart.x.label = keys.x_label.value_or(column.name);
  chart.x.unit = column.unit;
  chart.y.label = keys.density ? "share per width" : "number";
  for (std::size_t k = 0; k < found.counts.size(); ++k)
    chart.bars.push_back({in_unit(found.edges[k], column.unit), in_unit(found.edges[k + 1], column.unit),
                          keys.density ? found.density[k] * width : static_cast<double>(found.counts[k])});
  RunDirectory& run = run_of(call, "draws no pictures", "return its results, and draw it after the loop");
  warn_of(call, draw(chart, run.path_for(*keys.file)));
}

Values histogram_of_column(Call& call) {
  look_at_histogram(call);
  const std::string name = call.text(1, "column");
  const HistogramKeys keys = call.options(column_histogram_block, 2);
  if (keys.file) picture_format(*keys.file);
  const auto whole = table_of_self(call);
  const Rows table = rows_of(*whole, keys.where.rows(*whole));
  const TableColumn asked = split_column_unit(name);
  const std::string unit = table.display_unit_of(name, table.column(name, "column"));
  HistogramBins bins{keys.count, {}};
  for (const ExpectedValue& edge : keys.edges)
    bins.edges.push_back(edge.quantity.empty() ? from_unit(edge.value, asked.unit)
                                               : from_unit(parse_quantity_in(edge.quantity, unit), unit));
  const NumberColumns numbers = number_columns(table, {{"column", name}});
  ValueHistogram found = value_histogram(numbers.values[0], bins);
  found.left_out = numbers.left_out;
  if (keys.file) draw_histogram(call, keys, {asked.name, unit}, found);
  return {histogram_record(found)};
}

}  // namespace

void look_at_histogram(const Call& call) {
  if (call.argument(1).is_table() && !call.argument(1).is_unknown())
    refuse("histogram takes the column first", "write t:histogram(\"mu\", { bins=2 })");
}

const RecordInfo& histogram_type() { return histogram_record; }

Function mean_method() {
  return {.name = "mean",
          .body = mean_of_column,
          .sentence =
              "The mean of a column with its interval, as a table: one row, or one for each group of rows. "
              "Its columns are those of `by`, then mean, sd (standard deviation), u (standard uncertainty of "
              "the mean), low and high (the interval), n, left_out (cells that are empty or no finite "
              "number), skewness and interval (how it was computed).",
          .parameters = {{"column", "string", "the column"}},
          .options = optional(mean_block),
          .returns = "Table",
          .example = "print(book:mean(\"mu\", { by=\"D\" }))",
          .unknown_when_dry = true};
}

Function histogram_method() {
  return {.name = "histogram",
          .body = histogram_of_column,
          .sentence = "Counts of the values of a column in bins; `file` draws them.",
          .parameters = {{"column", "string", "the column"}},
          .options = optional(column_histogram_block),
          .returns = "Histogram",
          .example = "print(book:histogram(\"mu\", { bins=2 }))",
          .heavy = true,
          .look = look_at_histogram};
}

}  // namespace asperity::lua
