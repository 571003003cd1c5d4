// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/curve_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"
#include "engine/statistics/distributions.hpp"
#include "engine/statistics/least_squares.hpp"

namespace asperity {

UsedPoints used_points(const FitPoints& points, std::size_t parameters, double confidence) {
  if (!(confidence > 0 && confidence < 1))
    throw Error(ErrorCode::bad_value, "`confidence` is " + format_short(confidence),
                "give one above 0 and below 1, such as 0.95");
  const bool weighted = !points.weights.empty();
  if (points.x.size() != points.y.size() || (weighted && points.weights.size() != points.x.size()))
    throw Error(ErrorCode::bad_value,
                "the points of a fit have " + std::to_string(points.x.size()) + " x, " +
                    std::to_string(points.y.size()) + " y" +
                    (weighted ? " and " + std::to_string(points.weights.size()) + " weights" : ""),
                "give as many of one as of the other");
  UsedPoints used;
  for (std::size_t k = 0; k < points.x.size(); ++k) {
    const double weight = weighted ? points.weights[k] : 1;
    if (!std::isfinite(points.x[k]) || !std::isfinite(points.y[k]) || !std::isfinite(weight))
      throw Error(ErrorCode::bad_value, "point " + std::to_string(k + 1) + " of the fit is not finite");
    if (weight < 0)
      throw Error(ErrorCode::bad_value,
                  "the weight of point " + std::to_string(k + 1) + " is " + format_short(weight),
                  "weights are not negative; a usual one is 1/u² with u the uncertainty of y");
    if (weight == 0) continue;
    used.x.push_back(points.x[k]);
    used.y.push_back(points.y[k]);
    used.weights.push_back(weight);
  }
  if (used.x.size() < parameters + 1)
    throw Error(ErrorCode::bad_value,
                std::to_string(parameters) + (parameters == 1 ? " parameter" : " parameters") +
                    " cannot be fitted with intervals to " + std::to_string(used.x.size()) +
                    (used.x.size() == 1 ? " point" : " points"),
                "give at least " + std::to_string(parameters + 1) +
                    " rows with numbers in all columns and a weight above 0");
  return used;
}

namespace {

using Matrix = std::vector<std::vector<double>>;

double quadratic_form(const Matrix& matrix, const std::vector<double>& g) {
  double sum = 0;
  for (std::size_t i = 0; i < g.size(); ++i)
    for (std::size_t j = 0; j < g.size(); ++j) sum += g[i] * matrix[i][j] * g[j];
  return std::max(sum, 0.0);
}

// What a fit says beside its parameters: scatter, R², correlations, intervals. `covariance` is that of a
// scatter of 1 of the estimates in `values`.
CurveFit described(const UsedPoints& used, const std::vector<FitStart>& values, Matrix& covariance,
                   const std::vector<double>& fitted, double confidence) {
  CurveFit fit;
  fit.confidence = confidence;
  fit.points = used.x.size();
  fit.degrees = used.x.size() - values.size();
  double sum = 0, total = 0, weight = 0, centre = 0;
  for (std::size_t k = 0; k < used.x.size(); ++k) {
    const double residual = used.y[k] - fitted[k];
    fit.residuals.push_back(residual);
    sum += used.weights[k] * residual * residual;
    weight += used.weights[k];
    centre += used.weights[k] * used.y[k];
  }
  centre /= weight;
  for (std::size_t k = 0; k < used.x.size(); ++k)
    total += used.weights[k] * (used.y[k] - centre) * (used.y[k] - centre);
  const auto degrees = static_cast<double>(fit.degrees);
  fit.residual_deviation = std::sqrt(sum / degrees);
  if (total > 0) fit.r_squared = 1 - sum / total;
  if (fit.r_squared && *fit.r_squared < 0)
    fit.warnings.push_back("the curve is farther from the points than their mean is (R² = " +
                           format_short(*fit.r_squared, 3) + "): try another `start` or another model");
  for (auto& row : covariance)
    for (double& value : row) value *= sum / degrees;
  const double factor = student_t_factor(confidence, degrees);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double error = std::sqrt(std::max(covariance[k][k], 0.0)), value = values[k].value;
    fit.parameters.push_back({values[k].name, value, error, value - factor * error, value + factor * error});
  }
  return fit;
}

void add_correlation(CurveFit& fit, const Matrix& unscaled) {
  const std::size_t n = unscaled.size();
  fit.correlation.assign(n, std::vector<double>(n, 1.0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (i == j) continue;
      const double r = unscaled[i][j] / std::sqrt(unscaled[i][i] * unscaled[j][j]);
      fit.correlation[i][j] = std::clamp(r, -1.0, 1.0);
    }
}

// Of a model that is not known: the line and the power law have parameters that are far from independent
// wherever x is far from 0 and 1, and are determined all the same.
void warn_of_correlation(CurveFit& fit) {
  constexpr double hardly_apart = 0.999;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i)
    for (std::size_t j = i + 1; j < fit.parameters.size(); ++j)
      if (std::abs(fit.correlation[i][j]) > hardly_apart)
        fit.warnings.push_back("the points hardly tell " + quoted(fit.parameters[i].name) + " and " +
                               quoted(fit.parameters[j].name) + " apart: their correlation is " +
                               format_short(fit.correlation[i][j], 6));
}

// Parameters with the model they belong to; estimates of other parameters may be reported.
struct Inner {
  std::vector<double> values;
  std::vector<double> scales;
  Matrix covariance;
};

std::function<CurvePoint(double)> curve_with_band(const CurveModel& model, Inner inner, double degrees,
                                                  double confidence) {
  const double factor = student_t_factor(confidence, degrees);
  return [model, inner = std::move(inner), factor](double x) -> CurvePoint {
    const double y = model(x, inner.values);
    const std::vector<double> slope = slopes_of(model, x, inner.values, inner.scales);
    const double reach = factor * std::sqrt(quadratic_form(inner.covariance, slope));
    return {x, y, y - reach, y + reach};
  };
}

std::vector<FitStart> with_values(std::span<const FitStart> start, const std::vector<double>& values) {
  std::vector<FitStart> named(start.begin(), start.end());
  for (std::size_t k = 0; k < named.size(); ++k) named[k].value = values[k];
  return named;
}

// The straight line through the logarithms of the points whose x and y allow it; `sign` of y.
std::vector<double> power_start(const UsedPoints& used, double x0, double sign) {
  double sw = 0, su = 0, sv = 0;
  std::vector<std::pair<double, double>> logs;
  for (std::size_t k = 0; k < used.x.size(); ++k)
    if (used.x[k] > 0 && sign * used.y[k] > 0) {
      logs.emplace_back(elementary::log(used.x[k] / x0), elementary::log(sign * used.y[k]));
      sw += 1;
      su += logs.back().first;
      sv += logs.back().second;
    }
  double suu = 0, suv = 0;
  for (const auto& [u, v] : logs) {
    suu += (u - su / sw) * (u - su / sw);
    suv += (u - su / sw) * (v - sv / sw);
  }
  if (logs.size() < 2 || !(suu > 0)) return {};
  const double b = suv / suu;
  return {sign * elementary::exp(sv / sw - b * su / sw), b};
}

}  // namespace

CurveFit fit_line(const FitPoints& points, double confidence) {
  const UsedPoints used = used_points(points, 2, confidence);
  double weight = 0, x0 = 0, y0 = 0, largest = 0;
  for (std::size_t k = 0; k < used.x.size(); ++k) {
    weight += used.weights[k];
    x0 += used.weights[k] * used.x[k];
    y0 += used.weights[k] * used.y[k];
    largest = std::max(largest, std::abs(used.x[k]));
  }
  x0 /= weight;
  y0 /= weight;
  double xx = 0, xy = 0, spread = 0, x_rest = 0, y_rest = 0;
  for (std::size_t k = 0; k < used.x.size(); ++k) {
    const double u = used.x[k] - x0, v = used.y[k] - y0;
    xx += used.weights[k] * u * u;
    xy += used.weights[k] * u * v;
    x_rest += used.weights[k] * u;
    y_rest += used.weights[k] * v;
    spread = std::max(spread, std::abs(u));
  }
  if (!(spread > 16 * std::numeric_limits<double>::epsilon() * largest))
    throw Error(
        ErrorCode::infeasible,
        "the points do not tell `intercept` and `slope` apart: x is " + format_short(x0) + " in all of them",
        "measure at two or more values of x");
  // The means are rounded: what is left of them belongs to the sums about the true ones.
  x_rest /= weight;
  y_rest /= weight;
  xx -= weight * x_rest * x_rest;
  xy -= weight * x_rest * y_rest;
  const double slope = xy / xx, middle = y0 + y_rest - slope * x_rest, intercept = middle - slope * x0;
  std::vector<double> fitted;
  for (const double x : used.x) fitted.push_back(middle + slope * (x - x0));
  const double xc = x0 + x_rest;
  Matrix covariance = {{1 / weight + xc * xc / xx, -xc / xx}, {-xc / xx, 1 / xx}};
  const Matrix unscaled = covariance;
  CurveFit fit =
      described(used, {{"intercept", intercept}, {"slope", slope}}, covariance, fitted, confidence);
  fit.model = "y = intercept + slope x";
  fit.method = "linear least squares";
  add_correlation(fit, unscaled);
  // Beside the middle of x value and slope are independent: no digits are lost far from x = 0.
  const double scatter = fit.residual_deviation;
  const double factor = student_t_factor(confidence, static_cast<double>(fit.degrees));
  fit.at = [=](double x) -> CurvePoint {
    const double y = middle + slope * (x - x0), u = (x - x0) - x_rest;
    const double reach = factor * scatter * std::sqrt(1 / weight + u * u / xx);
    return {x, y, y - reach, y + reach};
  };
  return fit;
}

CurveFit fit_power(const FitPoints& points, double confidence) {
  const UsedPoints used = used_points(points, 2, confidence);
  double logs = 0;
  std::size_t above = 0;
  for (const double x : used.x) {
    if (x < 0)
      throw Error(ErrorCode::bad_value, "the power law has no value at x = " + format_short(x),
                  "it is fitted for x of 0 and above; leave other rows out, or give a function as the model");
    if (x > 0) logs += elementary::log(x), ++above;
  }
  // About the middle of the points factor and exponent are nearly independent.
  const double x0 = above > 0 ? elementary::exp(logs / static_cast<double>(above)) : 1;
  std::vector<double> begin = power_start(used, x0, 1);
  if (begin.empty()) begin = power_start(used, x0, -1);
  if (begin.empty())
    throw Error(ErrorCode::infeasible,
                "the points do not determine `a` and `b` of y = a x^b: fewer than two of different x have x "
                "above 0 and y of one sign",
                "measure at more values of x");
  const CurveModel about = [x0](double x, std::span<const double> q) {
    return q[0] * elementary::pow(x / x0, q[1]);
  };
  const std::vector<FitStart> inner_start = {{"a", begin[0]}, {"b", begin[1]}};
  const LeastSquares found = least_squares(used, about, inner_start);
  const double c = found.values[0], b = found.values[1], shift = elementary::pow(x0, -b), a = c * shift,
               log_x0 = elementary::log(x0);
  // d(a, b)/d(c, b)
  const Matrix& inner = found.covariance;
  const double ac = shift, ab = -a * log_x0;
  Matrix covariance(2, std::vector<double>(2));
  covariance[0][0] = ac * ac * inner[0][0] + 2 * ac * ab * inner[0][1] + ab * ab * inner[1][1];
  covariance[0][1] = covariance[1][0] = ac * inner[0][1] + ab * inner[1][1];
  covariance[1][1] = inner[1][1];
  const Matrix unscaled = covariance;
  CurveFit fit = described(used, {{"a", a}, {"b", b}}, covariance, found.fitted, confidence);
  fit.model = "y = a x^b";
  fit.method = "least squares of y, begun from the straight line through the logarithms";
  fit.iterations = found.iterations;
  add_correlation(fit, unscaled);
  Matrix scaled = inner;
  for (auto& row : scaled)
    for (double& value : row) value *= fit.residual_deviation * fit.residual_deviation;
  fit.at = curve_with_band(about, {found.values, found.scales, std::move(scaled)},
                           static_cast<double>(fit.degrees), confidence);
  return fit;
}

CurveFit fit_model(const FitPoints& points, const CurveModel& model, std::span<const FitStart> start,
                   double confidence) {
  if (start.empty())
    throw Error(ErrorCode::bad_value, "the model has no parameters to fit",
                "name them with the values to begin from, as in start={ a=1, b=0.5 }");
  const UsedPoints used = used_points(points, start.size(), confidence);
  const LeastSquares found = least_squares(used, model, start);
  Matrix covariance = found.covariance;
  CurveFit fit = described(used, with_values(start, found.values), covariance, found.fitted, confidence);
  fit.model = "the function given";
  fit.method = "nonlinear least squares (Levenberg-Marquardt)";
  fit.iterations = found.iterations;
  add_correlation(fit, found.covariance);
  warn_of_correlation(fit);
  fit.at = curve_with_band(model, {found.values, found.scales, std::move(covariance)},
                           static_cast<double>(fit.degrees), confidence);
  return fit;
}

std::vector<CurvePoint> sampled_curve(const CurveFit& fit, double low, double high, int count) {
  std::vector<double> places;
  for (int k = 0; k <= count; ++k) {
    const double share = static_cast<double>(k) / count;
    places.push_back(low * (1 - share) + high * share);
  }
  if (low > 0 && high > low)
    for (int k = 1; k < count; ++k)
      places.push_back(low * elementary::pow(high / low, static_cast<double>(k) / count));
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::vector<CurvePoint> curve;
  for (const double x : places) {
    const CurvePoint point = fit.at(x);
    if (std::isfinite(point.y) && std::isfinite(point.low) && std::isfinite(point.high))
      curve.push_back(point);
  }
  return curve;
}

}  // namespace asperity
