// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/expectation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/require.hpp"

namespace asperity {

namespace {

struct Value {
  std::size_t row;
  double number;
};

struct Level {
  double x;     // of the other column
  double mean;  // of rows with this x
};

struct Finding {
  std::string obstacle;
  std::vector<std::string> violations;
};

std::string row_name(std::size_t row) { return "row " + std::to_string(row + 1); }

// All digits if six hide the difference.
std::string telling(double value, double beside) {
  const std::string text = format_short(value);
  return value != beside && text == format_short(beside) ? format_exact(value) : text;
}

template <class Holds>
void judge_rows(const std::vector<Value>& values, double bound, const Holds& holds, Finding& finding) {
  constexpr std::size_t shown = 3;
  std::size_t offending = 0;
  std::string clause;
  for (const Value& value : values) {
    if (holds(value.number)) continue;
    if (++offending <= shown)
      clause += (clause.empty() ? "" : ", ") + row_name(value.row) + " has " + telling(value.number, bound);
  }
  if (offending == 0) return;
  if (offending > shown) clause += " and " + std::to_string(offending - shown) + " more";
  finding.violations.push_back(clause + " (" + std::to_string(offending) + " of " +
                               counted(values.size(), "row") + ")");
}

std::vector<Level> levels_of(const Table& table, const std::vector<Value>& values, std::size_t other,
                             std::string_view name, Finding& finding) {
  std::vector<std::pair<double, double>> points;
  for (const Value& value : values) {
    const auto x = number_in(table.cell(value.row, other));
    if (!x || std::isnan(*x)) {
      finding.obstacle = row_name(value.row) + " has " + short_text(table.cell(value.row, other)) + " in " +
                         quoted(name) + ", which has no order";
      return {};
    }
    points.emplace_back(*x, value.number);
  }
  std::ranges::sort(points);
  std::vector<Level> levels;
  for (std::size_t k = 0; k < points.size();) {
    double sum = 0;
    std::size_t end = k;
    while (end < points.size() && same_cell(points[end].first, points[k].first)) sum += points[end++].second;
    levels.push_back({points[k].first, sum / static_cast<double>(end - k)});
    k = end;
  }
  if (levels.size() < 2)
    finding.obstacle = "a trend in " + quoted(name) + " needs two of its values at least";
  return levels;
}

void judge_trend(const Table& table, const std::vector<Value>& values, const std::string& name, bool rising,
                 Finding& finding) {
  const auto other = table.find_column(name);
  if (!other) {
    finding.obstacle =
        "the notebook has no column " + quoted(name) + did_you_mean(name, table.column_names());
    return;
  }
  const std::vector<Level> levels = levels_of(table, values, *other, name, finding);
  if (!finding.obstacle.empty()) return;
  std::string clause;
  std::size_t offending = 0;
  for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
    const Level& a = levels[k];
    const Level& b = levels[k + 1];
    if (rising ? b.mean > a.mean : b.mean < a.mean) continue;
    if (++offending > 1) continue;
    const std::string step = a.mean == b.mean ? "stays at " + format_short(a.mean) + " from "
                                              : (b.mean > a.mean ? "rises from " : "falls from ") +
                                                    telling(a.mean, b.mean) + " to " +
                                                    telling(b.mean, a.mean) + " between ";
    clause = "it " + step + quoted(name) + " = " + telling(a.x, b.x) + (a.mean == b.mean ? " to " : " and ") +
             telling(b.x, a.x);
  }
  if (offending == 0) return;
  if (offending > 1) clause += " and turns " + std::to_string(offending - 1) + " more times";
  finding.violations.push_back(clause);
}

std::string shown(const ExpectedValue& wanted) {
  return wanted.quantity.empty() ? format_short(wanted.value) : wanted.quantity;
}

std::string wanted(const Expectation& e) {
  std::vector<std::string> parts;
  if (e.near) {
    std::string part = "near " + shown(*e.near);
    part += e.within ? " within " + shown(*e.within) : " within " + format_short(*e.relative * 100) + " %";
    parts.push_back(part);
  }
  if (e.at_least) parts.push_back("at least " + shown(*e.at_least));
  if (e.at_most) parts.push_back("at most " + shown(*e.at_most));
  if (e.increasing_in) parts.push_back("increasing in " + quoted(*e.increasing_in));
  if (e.decreasing_in) parts.push_back("decreasing in " + quoted(*e.decreasing_in));
  return joined(parts, " and ");
}

bool is_near(const Expectation& e, double value) {
  const double near = e.near->value;
  const double allowed = e.within ? e.within->value : *e.relative * std::abs(near);
  const double rounding =
      4 * std::numeric_limits<double>::epsilon() * std::max(std::abs(value), std::abs(near));
  return std::abs(value - near) <= allowed + (std::isfinite(rounding) ? rounding : 0.0);
}

// Values of `table`, which is `given` in display units.
std::vector<Value> values_of(const Expectation& e, const Table& given, const Table& table, Finding& finding) {
  std::vector<std::size_t> rows;
  try {
    rows = e.where.rows(given);
  } catch (const Error& error) {
    finding.obstacle = error.what();
    return {};
  }
  const auto column = table.find_column(e.column);
  if (!column) {
    finding.obstacle =
        "the notebook has no column " + quoted(e.column) + did_you_mean(e.column, table.column_names());
    return {};
  }
  if (rows.empty()) {
    finding.obstacle = table.rows() == 0 ? "the notebook has no rows" : "no row matches";
    return {};
  }
  std::vector<Value> values;
  for (const std::size_t row : rows) {
    const Cell& cell = table.cell(row, *column);
    if (is_empty(cell)) continue;
    const auto number = number_in(cell);
    if (!number || std::isnan(*number)) {
      finding.obstacle = row_name(row) + " has " + (number ? "nan" : "the text \"" + short_text(cell) + "\"");
      return {};
    }
    values.push_back({row, *number});
  }
  if (values.empty()) finding.obstacle = "none of the rows has a value in that column";
  return values;
}

std::string found_text(const std::vector<Value>& values, std::size_t rows_of_table) {
  const auto [low, high] =
      std::ranges::minmax_element(values, {}, [](const Value& value) { return value.number; });
  std::string text = counted(values.size(), "row");
  if (values.size() < rows_of_table) text += " of " + std::to_string(rows_of_table);
  text += low->number == high->number
              ? ", " + format_short(low->number)
              : ", " + telling(low->number, high->number) + " to " + telling(high->number, low->number);
  return text;
}

void require_number(const std::optional<ExpectedValue>& wanted, std::string_view key, bool finite,
                    bool positive) {
  if (!wanted) return;
  const double value = wanted->value;
  if (std::isnan(value) || (finite && !std::isfinite(value)) || (positive && value < 0))
    refuse(quoted(key) + " is " + shown(*wanted),
           positive ? "give a finite number, zero or above" : "give a number to compare with");
}

void require_order(const Expectation& e) {
  if (e.at_least && e.at_most && e.at_least->value > e.at_most->value)
    refuse("`at_least` is " + shown(*e.at_least) + " and `at_most` is " + shown(*e.at_most),
           "no value is both; exchange them");
}

void count_in_unit(std::optional<ExpectedValue>& wanted, std::string_view key, const TableColumn& column,
                   bool unit_in_name) {
  if (!wanted) return;
  const auto show_with_unit = [&] {
    if (!column.unit.empty()) wanted->quantity = format_short(wanted->value) + " " + column.unit;
  };
  if (wanted->quantity.empty()) {
    if (!unit_in_name) wanted->value = in_unit(wanted->value, column.unit);
    return show_with_unit();
  }
  const Quantity given = parse_quantity(wanted->quantity);
  const Dimension unit = parse_unit(column.unit).dimension;
  try {
    wanted->value = parse_quantity_in(wanted->quantity, column.unit);
  } catch (const Error&) {
    const std::string had = column.unit.empty() ? "has no unit" : "is in " + column.unit;
    const std::string kind =
        given.dimension == dimension::number ? "has no unit" : "is " + describe(given.dimension);
    const std::string other = unit == dimension::number ? "a share such as \"5 %\"" : describe(unit);
    throw Error(ErrorCode::bad_unit,
                quoted(key) + " is \"" + wanted->quantity + "\", which " + kind + ", and column " +
                    quoted(column.name) + " " + had,
                column.unit.empty()
                    ? "give a plain number, or the column its unit: book:units{ " + column.name + "=\"" +
                          si_unit(given.dimension) + "\" } before the first row"
                    : "give " + other + ", or a plain number in SI");
  }
  wanted->quantity = format_short(wanted->value);
  show_with_unit();
}

Expectation in_column_unit(const Expectation& expectation, const TableColumn& column) {
  Expectation counted = expectation;
  const bool unit_in_name = !split_column_unit(expectation.column).unit.empty();
  count_in_unit(counted.near, "near", column, unit_in_name);
  count_in_unit(counted.within, "within", column, unit_in_name);
  count_in_unit(counted.at_least, "at_least", column, unit_in_name);
  count_in_unit(counted.at_most, "at_most", column, unit_in_name);
  counted.column = column.name;
  return counted;
}

}  // namespace

ExpectedValue::ExpectedValue(std::string_view text) : value(parse_quantity(text).value), quantity(text) {}

void check(const Expectation& e) {
  if (!e.near && !e.at_least && !e.at_most && !e.increasing_in && !e.decreasing_in)
    refuse("the expectation of " + quoted(e.column) + " has no condition",
           "give `near` with `within` or `rel`, `at_least`, `at_most`, `increasing_in` or `decreasing_in`");
  if (e.near && e.within.has_value() == e.relative.has_value())
    refuse(e.within ? "`near` is given both `within` and `rel`" : "`near` needs a width",
           "give `within` (absolute) or `rel` (a fraction of `near`)");
  if (e.near && e.near->value == 0 && e.relative)
    refuse("`near` is 0, so `rel` gives no width", "give `within`");
  if (!e.near && (e.within || e.relative))
    refuse(std::string(e.within ? "`within`" : "`rel`") + " needs `near`", "give `near` as well");
  require_number(e.near, "near", true, false);
  require_number(e.within, "within", true, true);
  if (e.relative) require_number(ExpectedValue(*e.relative), "rel", true, true);
  require_number(e.at_least, "at_least", false, false);
  require_number(e.at_most, "at_most", false, false);
  // Comparable only in the column's unit.
  const bool of_one_kind =
      e.at_least && e.at_most && e.at_least->quantity.empty() == e.at_most->quantity.empty();
  if (of_one_kind) require_order(e);
  if (e.increasing_in && e.decreasing_in && *e.increasing_in == *e.decreasing_in)
    refuse("`increasing_in` and `decreasing_in` both name " + quoted(*e.increasing_in), "keep one of them");
}

Verdict evaluate(const Expectation& asked, const Table& given, std::string_view notebook) {
  check(asked);
  const Table table = in_display_units(given, {&asked.column, 1});
  Expectation e = asked;
  std::string unit;
  if (table.find_column(e.column)) {
    const TableColumn& column = table.columns()[table.column(e.column, "column")];
    e = in_column_unit(asked, column);
    require_order(e);
    unit = column.unit.empty() ? "" : " " + column.unit;
  }
  Finding finding;
  const std::vector<Value> values = values_of(e, given, table, finding);
  if (finding.obstacle.empty()) {
    if (e.near)
      judge_rows(
          values, e.near->value, [&](double v) { return is_near(e, v); }, finding);
    if (e.at_least)
      judge_rows(
          values, e.at_least->value, [&](double v) { return v >= e.at_least->value; }, finding);
    if (e.at_most)
      judge_rows(
          values, e.at_most->value, [&](double v) { return v <= e.at_most->value; }, finding);
    if (e.increasing_in) judge_trend(table, values, *e.increasing_in, true, finding);
    if (finding.obstacle.empty() && e.decreasing_in)
      judge_trend(table, values, *e.decreasing_in, false, finding);
  }

  Verdict verdict;
  verdict.notebook = notebook;
  verdict.label = e.label;
  verdict.should_fail = e.should_fail;
  verdict.judged = finding.obstacle.empty();
  const bool holds = verdict.judged && finding.violations.empty();
  verdict.passed = verdict.judged && holds != e.should_fail;

  const std::string subject = quoted(e.column) + (e.where.empty() ? "" : " where " + e.where.text());
  if (!verdict.judged) {
    verdict.sentence = subject + " cannot be judged " + wanted(e) + ": " + finding.obstacle;
  } else if (holds) {
    verdict.sentence = std::string(e.should_fail ? "holds, and should fail: " : "") + subject + " is " +
                       wanted(e) + " (" + found_text(values, table.rows()) + unit + ")";
  } else {
    verdict.sentence =
        (e.should_fail ? "fails, as it should: " + subject + " is not " : subject + " should be ") +
        wanted(e) + ", but " + joined(finding.violations, " and ");
    if (e.should_fail) {
      const std::size_t comma = verdict.sentence.rfind(", but ");
      verdict.sentence.replace(comma, 6, ": ");
    }
  }
  return verdict;
}

Json to_json(const Verdict& verdict) {
  Json json;
  json.set("notebook", verdict.notebook).set("passed", verdict.passed);
  if (!verdict.judged) json.set("judged", false);
  if (verdict.should_fail) json.set("should_fail", true);
  if (!verdict.label.empty()) json.set("label", verdict.label);
  json.set("sentence", verdict.sentence);
  return json;
}

void ExpectationLog::add(Verdict verdict) {
  const std::lock_guard lock(mutex_);
  verdicts_.push_back(std::move(verdict));
}

std::vector<Verdict> ExpectationLog::exchange(std::vector<Verdict> verdicts) {
  const std::lock_guard lock(mutex_);
  return std::exchange(verdicts_, std::move(verdicts));
}

std::vector<Verdict> ExpectationLog::verdicts() const {
  const std::lock_guard lock(mutex_);
  return verdicts_;
}

std::size_t ExpectationLog::failed() const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::size_t>(std::ranges::count(verdicts_, false, &Verdict::passed));
}

std::string ExpectationLog::summary() const {
  const std::vector<Verdict> all = verdicts();
  if (all.empty()) return {};
  const auto held = static_cast<std::size_t>(std::ranges::count(all, true, &Verdict::passed));
  const auto controls = static_cast<std::size_t>(
      std::ranges::count_if(all, [](const Verdict& v) { return v.passed && v.should_fail; }));
  const bool one = all.size() == 1;
  std::string text;
  if (held == all.size()) {
    text = one ? "1 expectation holds" : std::to_string(all.size()) + " expectations hold";
  } else {
    text = std::to_string(all.size() - held) + " of " + std::to_string(all.size()) +
           (one ? " expectation" : " expectations") + (all.size() - held == 1 ? " fails" : " fail");
  }
  if (controls == 1) text += " (1 negative control fails, as it should)";
  if (controls > 1) text += " (" + std::to_string(controls) + " negative controls fail, as they should)";
  return text;
}

}  // namespace asperity
