// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/calibration_report.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/core/require.hpp"

namespace asperity {

namespace {

std::string padded(std::string text, std::size_t width) {
  const std::size_t length = characters_of(text);
  return length < width ? text + std::string(width - length, ' ') : text;
}

std::string percent(double share) { return format_short(100 * share, 4) + " %"; }

std::string parameter_text(const CalibrationReport& report, std::size_t p, const std::optional<double>& value,
                           int digits = 4) {
  if (!value) return "open";
  if (report.units.empty()) return format_quantity(*value, report.dimensions[p], digits);
  const std::string& unit = report.units[p];
  return format_short(in_unit(*value, unit), digits) + (unit.empty() ? "" : " " + unit);
}

std::string limits(const CalibrationReport& report, std::size_t p, const std::optional<double>& low,
                   const std::optional<double>& high) {
  return parameter_text(report, p, low) + " to " + parameter_text(report, p, high);
}

std::string scatter_text(const CalibrationReport& report) {
  const Calibration& found = report.found;
  if (found.degrees == 0) return "";
  const std::string of = found.by_specimens ? "specimens scatter by " : "rows scatter by ";
  if (report.known_uncertainty) return of + format_short(found.residual_deviation, 3) + " times their u";
  if (report.scatter == CalibrationScatter::relative) return of + percent(found.residual_deviation);
  const auto column = report.rows.find_column(report.y);
  const std::string unit = column ? report.rows.columns()[*column].unit : "";
  return of + format_short(in_unit(found.residual_deviation, unit), 4) + (unit.empty() ? "" : " " + unit);
}

struct Sampled {
  std::vector<double> x, y;
};

// Interpolates the root of the excess: nearly linear, with a sign change at the estimate.
Sampled sampled_profile(const std::vector<ProfilePoint>& points) {
  Sampled found;
  const auto least = std::ranges::min_element(points, {}, &ProfilePoint::excess);
  const auto root = [&](std::size_t k) {
    const double size = std::sqrt(std::max(points[k].excess, 0.0));
    return points[k].value < least->value ? -size : size;
  };
  constexpr int parts = 24;
  for (std::size_t k = 0; k + 1 < points.size(); ++k)
    for (int part = 0; part < parts; ++part) {
      const double share = static_cast<double>(part) / parts;
      const double z = root(k) * (1 - share) + root(k + 1) * share;
      found.x.push_back(points[k].value * (1 - share) + points[k + 1].value * share);
      found.y.push_back(z * z);
    }
  found.x.push_back(points.back().value);
  found.y.push_back(points.back().excess);
  return found;
}

std::vector<double> numbers_of_column(const CalibrationReport& report, const std::string& name) {
  const std::size_t column = report.rows.column(name, "x");
  std::vector<double> values;
  for (std::size_t row = 0; row < report.rows.rows(); ++row) {
    const Cell& cell = report.rows.cell(row, column);
    if (!is_number(cell) || !std::isfinite(*number_in(cell)))
      refuse("column " + quoted(name) + " holds " + short_text(cell) + " in row " +
                 std::to_string(report.numbers[row]) + ", and is no axis of a chart",
             "give a column that holds a number in each row that was fitted");
    values.push_back(*number_in(cell));
  }
  return values;
}

std::vector<std::size_t> in_order_of(const std::vector<double>& x) {
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return x[a] < x[b]; });
  return order;
}

bool is_curve(const std::vector<double>& x, const std::vector<double>& fitted,
              const std::vector<std::size_t>& order) {
  for (std::size_t k = 0; k + 1 < order.size(); ++k) {
    const double a = fitted[order[k]], b = fitted[order[k + 1]];
    if (x[order[k]] == x[order[k + 1]] && std::abs(a - b) > 1e-9 * std::max(std::abs(a), std::abs(b)))
      return false;
  }
  return true;
}

}  // namespace

std::string calibration_text(const CalibrationReport& report) {
  const Calibration& found = report.found;
  std::string text =
      (report.curve ? "fit of " + report.y + " against " + report.curve->x : "calibration of " + report.y) +
      " over " + counted(report.numbers.size(), "row");
  if (report.left_out > 0) text += " (" + std::to_string(report.left_out) + " more without numbers)";
  if (!found.specimens.empty()) text += " of " + counted(found.specimens.size(), "specimen");
  text += ", " + counted(found.degrees, "degree") + " of freedom";
  if (const std::string scatter = scatter_text(report); !scatter.empty()) text += "; " + scatter;
  std::size_t width = 9;
  for (const CalibratedParameter& of : found.parameters) width = std::max(width, characters_of(of.name));
  const std::string share = percent(found.confidence);
  const bool profiles = std::ranges::any_of(
      found.parameters, [](const CalibratedParameter& of) { return !of.profile.empty(); });
  text += "\n  " + padded("", width) + "  " + padded("estimate", 13) + padded("u", 13) +
          (profiles ? padded(share + " linearised", 28) + share + " by profile" : share + " linearised");
  for (std::size_t p = 0; p < found.parameters.size(); ++p) {
    const CalibratedParameter& of = found.parameters[p];
    std::string line = "\n  " + padded(of.name, width) + "  ";
    if (!of.value) {
      text += line + "not identifiable";
      continue;
    }
    line += padded(parameter_text(report, p, of.value), 12) + " ";
    line += padded(of.standard_error ? parameter_text(report, p, of.standard_error, 2) : "", 12) + " ";
    line += padded(of.low        ? limits(report, p, of.low, of.high)
                   : of.at_lower ? "at its lower bound"
                   : of.at_upper ? "at its upper bound"
                                 : "",
                   28);
    if (!of.profile.empty()) line += limits(report, p, of.profile_low, of.profile_high);
    while (line.ends_with(' ')) line.pop_back();
    text += line;
  }
  std::string between;
  for (std::size_t i = 0; i < found.parameters.size(); ++i)
    for (std::size_t j = i + 1; j < found.parameters.size(); ++j)
      if (found.correlation[i][j])
        between += (between.empty() ? "" : ", ") + found.parameters[i].name + " with " +
                   found.parameters[j].name + " " + format_short(*found.correlation[i][j], 3);
  if (!between.empty()) text += "\n  correlation: " + between;
  if (found.condition)
    text += (between.empty() ? "\n  " : "; ") + ("condition " + format_short(*found.condition, 3));
  if (report.r_squared) text += (found.condition ? "; R² " : "\n  R² ") + format_short(*report.r_squared, 6);
  text += "\n  verdict: " + found.verdict;
  for (const std::string& warning : found.warnings) text += "\n  warning: " + warning;
  return text;
}

std::string calibration_digest(const CalibrationReport& report) {
  Digester digest;
  digest.add("calibration");
  const auto add = [&](const std::optional<double>& value) {
    digest.add(value ? 1 : 0);
    digest.add(value.value_or(0));
  };
  for (const CalibratedParameter& of : report.found.parameters) {
    digest.add(of.name);
    for (const auto& value : {of.value, of.standard_error, of.low, of.high, of.profile_low, of.profile_high})
      add(value);
  }
  for (const double value : report.found.fitted) digest.add(value);
  digest.add(report.found.verdict);
  return digest.hex();
}

LineChart calibration_chart(const CalibrationReport& report, const std::optional<std::string>& x) {
  const Calibration& found = report.found;
  const auto y_column = report.rows.find_column(report.y);
  LineChart chart;
  chart.y.label = report.y;
  chart.y.unit = y_column ? report.rows.columns()[*y_column].unit : "";
  const std::vector<double> along = x ? numbers_of_column(report, *x) : found.fitted;
  if (x) {
    const TableColumn& column = report.rows.columns()[report.rows.column(*x, "x")];
    chart.x.label = column.name;
    chart.x.unit = column.unit;
  } else {
    chart.x.label = report.y + " of the fit";
    chart.x.unit = chart.y.unit;
  }
  ChartSeries measured;
  measured.name = "measured";
  measured.line = false;
  ChartSeries fit;
  fit.name = found.fitted_low.front() ? "fit, " + percent(found.confidence) + " band" : "fit";
  const std::vector<std::size_t> order = in_order_of(along);
  const bool curve = is_curve(along, found.fitted, order);
  fit.line = curve;
  fit.points = !curve;
  fit.band = curve && found.fitted_low.front().has_value();
  for (const std::size_t k : order) {
    measured.x.push_back(along[k]);
    measured.y.push_back(found.fitted[k] + found.residuals[k]);
    if (curve && !fit.x.empty() && fit.x.back() == along[k]) continue;
    fit.x.push_back(along[k]);
    fit.y.push_back(found.fitted[k]);
    if (!found.fitted_low[k]) continue;
    fit.y_low.push_back(*found.fitted_low[k]);
    fit.y_high.push_back(*found.fitted_high[k]);
  }
  chart.series = {std::move(fit), std::move(measured)};
  for (ChartSeries& series : chart.series) {
    for (double& value : series.x) value = in_unit(value, chart.x.unit);
    for (auto* values : {&series.y, &series.y_low, &series.y_high})
      for (double& value : *values) value = in_unit(value, chart.y.unit);
  }
  return chart;
}

std::vector<LineChart> likelihood_charts(const CalibrationReport& report) {
  std::vector<LineChart> panels;
  for (std::size_t p = 0; p < report.found.parameters.size(); ++p) {
    const CalibratedParameter& of = report.found.parameters[p];
    if (of.profile.size() < 2) continue;
    LineChart chart;
    chart.x.label = of.name;
    chart.x.unit = si_unit(report.dimensions[p]);
    chart.y.label = "(S - Smin) / s^2";
    ChartSeries line;
    line.name = "profile of " + of.name;
    line.points = false;
    Sampled sampled = sampled_profile(of.profile);
    line.x = std::move(sampled.x);
    line.y = std::move(sampled.y);
    chart.series = {std::move(line)};
    chart.references = {{{}, report.found.cut, percent(report.found.confidence) + " limit"}};
    if (of.value) chart.references.push_back({*of.value, {}, "estimate"});
    panels.push_back(std::move(chart));
  }
  if (panels.empty())
    refuse(
        "the calibration has no profile likelihood to draw",
        "it has none with profile=false, without degrees of freedom, and of parameters that the rows do not "
        "determine");
  return panels;
}

}  // namespace asperity
