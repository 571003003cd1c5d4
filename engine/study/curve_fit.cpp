// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/curve_fit.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

constexpr double difference_step = 1e-5;  // relative to each parameter
constexpr int curve_steps = 100;

void check_points(const CalibrationRows& rows, std::size_t parameters, const CalibrationOptions& options) {
  if (rows.x.size() != rows.y.size())
    refuse("the points of a fit have " + std::to_string(rows.x.size()) + " x and " +
               std::to_string(rows.y.size()) + " y",
           "give as many of one as of the other");
  for (std::size_t k = 0; k < rows.x.size(); ++k)
    if (!std::isfinite(rows.x[k]))
      refuse("x of point " + std::to_string(k + 1) + " of the fit is not finite");
  const std::size_t least = parameters + (rows.u.empty() || options.relative_u ? 1 : 0);
  if (rows.x.size() < least)
    refuse(
        counted(parameters, "parameter") + " cannot be fitted with intervals to " +
            counted(rows.x.size(), "point"),
        "give at least " + std::to_string(least) + " rows with numbers in all columns and a weight above 0");
}

double weight_of(const CalibrationRows& rows, std::size_t k) {
  return rows.u.empty() ? 1 : 1 / (rows.u[k] * rows.u[k]);
}

// Weighted: y at the mean of x, slope, mean of x.
std::array<double, 3> straight_line(const CalibrationRows& rows) {
  double weight = 0, x0 = 0, y0 = 0, xx = 0, xy = 0;
  for (std::size_t k = 0; k < rows.x.size(); ++k) {
    weight += weight_of(rows, k);
    x0 += weight_of(rows, k) * rows.x[k];
    y0 += weight_of(rows, k) * rows.y[k];
  }
  x0 /= weight;
  y0 /= weight;
  for (std::size_t k = 0; k < rows.x.size(); ++k) {
    xx += weight_of(rows, k) * (rows.x[k] - x0) * (rows.x[k] - x0);
    xy += weight_of(rows, k) * (rows.x[k] - x0) * (rows.y[k] - y0);
  }
  return {y0, xx > 0 ? xy / xx : 0, x0};
}

// Equal steps; for `low` above 0 also equal ratios.
std::vector<double> places_of_curve(double low, double high) {
  std::vector<double> places;
  for (int k = 0; k <= curve_steps; ++k) {
    const double share = static_cast<double>(k) / curve_steps;
    places.push_back(low * (1 - share) + high * share);
    if (low > 0 && k > 0 && k < curve_steps) places.push_back(low * elementary::pow(high / low, share));
  }
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

// Interval by differences of 0.01 standard errors.
std::vector<CurvePoint> curve_of(const Calibration& found, const CurveModel& model, double low, double high) {
  std::vector<double> q;
  for (const CalibratedParameter& of : found.parameters) q.push_back(*of.value);
  std::vector<CurvePoint> curve;
  for (const double x : places_of_curve(low, high)) {
    std::vector<double> effect;  // per standard error
    for (std::size_t p = 0; p < q.size(); ++p) {
      const double u = found.parameters[p].standard_error.value_or(0);
      std::vector<double> above = q, below = q;
      above[p] += 0.01 * u;
      below[p] -= 0.01 * u;
      effect.push_back(u > 0 ? 50 * (model(x, above) - model(x, below)) : 0);
    }
    double variance = 0;
    for (std::size_t i = 0; i < q.size(); ++i)
      for (std::size_t j = 0; j < q.size(); ++j)
        variance += effect[i] * effect[j] * found.correlation[i][j].value_or(0);
    const double y = model(x, q), reach = std::sqrt(found.cut * std::max(variance, 0.0));
    if (std::isfinite(y) && std::isfinite(reach)) curve.push_back({x, y, y - reach, y + reach});
  }
  return curve;
}

// Parameters become T q.
void express(Calibration& found, const std::array<std::array<double, 2>, 2>& t,
             const std::array<double, 2>& values) {
  double covariance[2][2] = {};
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j)
      for (std::size_t k = 0; k < 2; ++k)
        for (std::size_t l = 0; l < 2; ++l)
          covariance[i][j] += t[i][k] * t[j][l] * found.correlation[k][l].value_or(0) *
                              found.parameters[k].standard_error.value_or(0) *
                              found.parameters[l].standard_error.value_or(0);
  for (std::size_t i = 0; i < 2; ++i) {
    CalibratedParameter& of = found.parameters[i];
    of.value = values[i];
    if (!of.standard_error) continue;
    of.standard_error = std::sqrt(covariance[i][i]);
    of.low = values[i] - std::sqrt(found.cut) * *of.standard_error;
    of.high = values[i] + std::sqrt(found.cut) * *of.standard_error;
  }
  const double scale = std::sqrt(covariance[0][0] * covariance[1][1]);
  if (scale > 0)
    found.correlation[0][1] = found.correlation[1][0] = std::clamp(covariance[0][1] / scale, -1.0, 1.0);
}

}  // namespace

CurveFit fit_model(const CalibrationRows& rows, const CurveModel& model,
                   std::vector<CalibrationParameter> parameters, const CalibrationOptions& options,
                   const RowModel& in_row) {
  check_points(rows, parameters.size(), options);
  for (CalibrationParameter& of : parameters) of.step = difference_step;
  CurveFit fit;
  fit.found = calibrate(
      rows,
      [&](std::span<const double> q, std::size_t row) {
        return in_row ? in_row(row, q) : model(rows.x[row], q);
      },
      parameters, options);
  if (!fit.found.identifiable || !std::ranges::all_of(fit.found.parameters, &CalibratedParameter::determined))
    refuse_infeasible("the points do not determine every parameter: " + fit.found.verdict,
                      "write the model with fewer parameters; lab.calibrate shows the determined ones");
  const double centre = straight_line(rows)[0];
  double total = 0, left = 0;
  for (std::size_t k = 0; k < rows.y.size(); ++k) {
    total += weight_of(rows, k) * (rows.y[k] - centre) * (rows.y[k] - centre);
    left += weight_of(rows, k) * fit.found.residuals[k] * fit.found.residuals[k];
  }
  if (total > 0) fit.r_squared = 1 - left / total;
  if (fit.r_squared && *fit.r_squared < 0)
    fit.found.warnings.push_back("the curve is farther from the points than their mean is (R² = " +
                                 format_short(*fit.r_squared, 3) + "): try another `start` or another model");
  const auto [low, high] = std::ranges::minmax(rows.x);
  fit.curve = curve_of(fit.found, model, low, high);
  return fit;
}

CurveFit fit_line(const CalibrationRows& rows, const CalibrationOptions& options) {
  check_points(rows, 2, options);
  const auto [middle, slope, x0] = straight_line(rows);
  double spread = 0, largest = 0;
  for (const double x : rows.x) {
    spread = std::max(spread, std::abs(x - x0));
    largest = std::max(largest, std::abs(x));
  }
  if (!(spread > 16 * std::numeric_limits<double>::epsilon() * largest))
    refuse_infeasible(
        "the points cannot separate `intercept` and `slope`: x is " + format_short(x0) + " in all of them",
        "measure at two or more values of x");
  CalibrationOptions straight = options;
  straight.profile = false;  // linearised is exact here
  CurveFit fit = fit_model(
      rows, [x0 = x0](double x, std::span<const double> q) { return q[0] + q[1] * (x - x0); },
      {{"intercept", middle, {}, {}}, {"slope", slope, {}, {}}}, straight);
  const double c = *fit.found.parameters[0].value, b = *fit.found.parameters[1].value;
  express(fit.found, {{{1, -x0}, {0, 1}}}, {c - b * x0, b});
  return fit;
}

CurveFit fit_power(const CalibrationRows& rows, const CalibrationOptions& options) {
  check_points(rows, 2, options);
  CalibrationRows logs[2];
  for (std::size_t k = 0; k < rows.x.size(); ++k) {
    if (rows.x[k] < 0)
      refuse("the power law has no value at x = " + format_short(rows.x[k]),
             "it is fitted for x of 0 and above; leave other rows out, or give a function as the model");
    if (!(rows.x[k] > 0) || rows.y[k] == 0) continue;
    CalibrationRows& of = logs[rows.y[k] > 0 ? 0 : 1];
    of.x.push_back(elementary::log(rows.x[k]));
    of.y.push_back(elementary::log(std::abs(rows.y[k])));
  }
  const bool negative = logs[1].x.size() > logs[0].x.size();
  const CalibrationRows& used = logs[negative ? 1 : 0];
  if (used.x.size() < 2 || std::ranges::min(used.x) == std::ranges::max(used.x))
    refuse_infeasible(
        "the points do not determine `a` and `b` of y = a x^b: fewer than two of different x have x "
        "above 0 and y of one sign",
        "measure at more values of x");
  const auto [height, slope, log_x0] = straight_line(used);
  const double x0 = elementary::exp(log_x0);
  CalibrationOptions linearised = options;
  linearised.profile = false;
  CurveFit fit = fit_model(
      rows, [x0](double x, std::span<const double> q) { return q[0] * elementary::pow(x / x0, q[1]); },
      {{"a", (negative ? -1 : 1) * elementary::exp(height), {}, {}}, {"b", slope, {}, {}}}, linearised);
  const double b = *fit.found.parameters[1].value, shift = elementary::pow(x0, -b),
               a = *fit.found.parameters[0].value * shift;
  express(fit.found, {{{shift, -a * log_x0}, {0, 1}}}, {a, b});
  return fit;
}

}  // namespace asperity
