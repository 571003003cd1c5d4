// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/sample_mean.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/require.hpp"
#include "engine/statistics/distributions.hpp"
#include "engine/statistics/table_operations.hpp"

namespace asperity {

namespace {

struct Moments {
  double centre = 0, second = 0, third = 0;  // central power sums
};

// No square may overflow.
Moments moments_of(std::span<const double> values, double scale) {
  Moments found;
  const auto n = static_cast<double>(values.size());
  for (const double value : values) found.centre += value / scale / n;
  double rest = 0;
  for (const double value : values) rest += value / scale - found.centre;
  found.centre += rest / n;
  for (const double value : values) {
    const double d = value / scale - found.centre;
    found.second += d * d;
    found.third += d * d * d;
  }
  return found;
}

double largest_of(std::span<const double> values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest > 0 ? largest : 1;
}

void add_student_interval(SampleMean& of) {
  const double reach =
      student_t_factor(of.confidence, static_cast<double>(of.count - 1)) * *of.standard_error;
  of.low = of.mean - reach;
  of.high = of.mean + reach;
  of.method = "Student's t, " + counted(of.count - 1, "degree") + " of freedom";
  const double cv = of.mean != 0 ? *of.deviation / std::abs(of.mean) : 0;
  if (of.skewness && std::abs(*of.skewness) > 1 && cv > 0.5)
    of.warnings.push_back("the values are skewed (skewness " + format_short(*of.skewness, 2) +
                          ", coefficient of variation " + format_short(cv, 2) +
                          "): Student's interval has less than its nominal coverage; interval=\"log\" "
                          "assumes that the logarithms are normal");
}

void add_log_interval(SampleMean& of, std::span<const double> values) {
  std::vector<double> logs;
  for (const double value : values) {
    if (!(value > 0))
      refuse("a log interval needs values above 0, and one is " + format_short(value),
             "leave `interval` out for Student's t");
    logs.push_back(elementary::log(value));
  }
  const auto n = static_cast<double>(logs.size());
  const Moments found = moments_of(logs, 1);
  const double variance = found.second / (n - 1);
  of.log_centre = found.centre + variance / 2;
  of.log_error = std::sqrt(variance / n + variance * variance / (2 * (n - 1)));
  const double reach = student_t_factor(of.confidence, n - 1) * of.log_error;
  of.low = elementary::exp(of.log_centre - reach);
  of.high = elementary::exp(of.log_centre + reach);
  of.method = "log interval of Cox, " + counted(of.count - 1, "degree") +
              " of freedom; assumes that the logarithms are normal";
}

bool cells_before(const std::vector<Cell>& a, const std::vector<Cell>& b) {
  for (std::size_t k = 0; k < a.size(); ++k)
    if (!same_cell(a[k], b[k])) return comes_before(a[k], b[k]);
  return false;
}

std::string group_text(const std::vector<std::string>& by, const std::vector<Cell>& cells) {
  std::string text;
  for (std::size_t k = 0; k < by.size(); ++k)
    text += (k > 0 ? " and " : "") + quoted(by[k]) + " = " + short_text(cells[k]);
  return text;
}

}  // namespace

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

SampleMean sample_mean(std::span<const double> values, MeanInterval interval, double confidence) {
  if (!(confidence > 0 && confidence < 1))
    refuse("`confidence` is " + format_short(confidence), "give one above 0 and below 1, such as 0.95");
  std::vector<double> finite;
  for (const double value : values)
    if (std::isfinite(value)) finite.push_back(value);
  SampleMean of;
  of.confidence = confidence;
  of.count = finite.size();
  of.left_out = values.size() - finite.size();
  if (finite.empty())
    refuse("there is no number to take the mean of",
           values.empty() ? "" : std::to_string(values.size()) + " cells are empty or not finite");
  const auto n = static_cast<double>(of.count);
  const double scale = largest_of(finite);
  const Moments found = moments_of(finite, scale);
  of.mean = found.centre * scale;
  if (of.count < 5)
    of.warnings.push_back(
        "the mean of " + std::to_string(of.count) +
        (of.count == 1 ? " value has no interval" : " values: the scatter of fewer than five is uncertain"));
  if (of.count < 2) {
    of.method = "none: one value";
    return of;
  }
  of.deviation = std::sqrt(found.second / (n - 1)) * scale;
  of.standard_error = *of.deviation / std::sqrt(n);
  const double spread = std::sqrt(found.second / n);
  if (of.count > 2 && spread > 8 * std::numeric_limits<double>::epsilon()) {
    const double skewness = found.third / n / (spread * spread * spread);
    of.skewness = std::abs(skewness) < 1e-9 ? 0 : skewness;
  }
  if (interval == MeanInterval::student)
    add_student_interval(of);
  else
    add_log_interval(of, finite);
  return of;
}

std::vector<GroupMean> means_of(const Table& table, const std::string& column,
                                const std::vector<std::string>& by, MeanInterval interval,
                                double confidence) {
  std::vector<std::size_t> places;
  for (const std::string& name : by) places.push_back(table.column(name, "by"));
  const NumberColumns numbers = number_columns(table, {{"column", column}});
  struct Group {
    std::vector<Cell> cells;
    std::vector<double> values;
  };
  std::vector<Group> groups;
  if (by.empty()) groups.push_back({});
  std::size_t next = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::vector<Cell> cells;
    for (const std::size_t place : places) cells.push_back(table.cell(row, place));
    auto group = std::ranges::find_if(groups, [&](const Group& g) {
      return std::equal(g.cells.begin(), g.cells.end(), cells.begin(), cells.end(), same_cell);
    });
    if (group == groups.end()) group = groups.insert(groups.end(), {std::move(cells), {}});
    const bool known = next < numbers.rows.size() && numbers.rows[next] == row;
    group->values.push_back(known ? numbers.values[0][next] : std::numeric_limits<double>::quiet_NaN());
    if (known) ++next;
  }
  std::ranges::stable_sort(groups, cells_before, &Group::cells);
  std::vector<GroupMean> means;
  for (Group& group : groups) {
    const bool none = std::ranges::none_of(group.values, [](double v) { return std::isfinite(v); });
    if (none && !by.empty()) {
      SampleMean empty;
      empty.left_out = group.values.size();
      empty.mean = std::numeric_limits<double>::quiet_NaN();
      empty.confidence = confidence;
      empty.method = "none: no value";
      empty.warnings = {"no number in " + std::to_string(group.values.size()) + " rows"};
      means.push_back({std::move(group.cells), std::move(empty)});
      continue;
    }
    try {
      means.push_back({group.cells, sample_mean(group.values, interval, confidence)});
    } catch (const Error& error) {
      const std::string where = group_text(by, group.cells);
      throw Error(
          error.code(),
          "column " + quoted(column) + (where.empty() ? "" : " where " + where) + ": " + error.sentence(),
          error.hint());
    }
  }
  return means;
}

}  // namespace asperity
