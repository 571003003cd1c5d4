// SPDX-License-Identifier: GPL-3.0-or-later
// A curve fitted to measured points: y = f(x, q) by least squares with relative weights, S = Σ w (y - f)².
// The straight line in closed form; the power law and any other function by Levenberg and Marquardt's method
// with derivatives by differences. Parameters have linearised intervals with Student's t of n - p degrees;
// the scatter is taken from the residuals, so that only ratios of weights count. What the data do not
// determine is refused by name. x is taken as exact, and residuals as independent of each other.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace asperity {

// The value at x with these parameters; not a number where there is none.
using CurveModel = std::function<double(double x, std::span<const double> parameters)>;

struct FitPoints {
  std::vector<double> x, y;
  std::vector<double> weights{};  // one each, not negative; none: all alike
};

// Those that count: with a weight above 0.
struct UsedPoints {
  std::vector<double> x, y, weights;
};
// Throws Error{bad_value} as the fits below do.
UsedPoints used_points(const FitPoints& points, std::size_t parameters, double confidence);

struct FitStart {
  std::string name;
  double value = 0;
};

struct FittedParameter {
  std::string name;
  double value = 0;
  double standard_error = 0;
  double low = 0, high = 0;
};

// The curve at one x with the interval of the curve (not of a further measurement) there.
struct CurvePoint {
  double x = 0, y = 0, low = 0, high = 0;
};

struct CurveFit {
  std::string model;   // "y = intercept + slope x"
  std::string method;  // "linear least squares"
  std::vector<FittedParameter> parameters;
  std::vector<std::vector<double>> correlation;  // of the estimates, row by row
  std::vector<double> residuals;                 // y - f, of each point that was used
  std::size_t points = 0;                        // with a weight above 0
  std::size_t degrees = 0;                       // points - parameters
  double residual_deviation = 0;    // sqrt(S / degrees): standard deviation of a point of weight 1
  std::optional<double> r_squared;  // 1 - S/Σ w (y - mean)²; none where every y is the same
  double confidence = 0.95;
  int iterations = 0;  // 0 for a closed form
  std::vector<std::string> warnings;
  // The curve with its pointwise interval. Calls the model.
  std::function<CurvePoint(double x)> at;
};

// All throw Error{bad_value} for lengths that differ, for values that are not finite, for a weight below 0,
// for a confidence that is not between 0 and 1, and for fewer points than parameters + 1; Error{infeasible}
// naming the parameters that the points do not determine.
CurveFit fit_line(const FitPoints& points, double confidence = 0.95);
// y = a x^b by least squares of y itself, begun from the straight line through the logarithms. Throws besides
// Error{bad_value} for x below 0, and where fewer than two points of different x have x and y that begin it.
CurveFit fit_power(const FitPoints& points, double confidence = 0.95);
// Any function, begun from `start`, which names the parameters. Throws besides Error{bad_value} where the
// model is no finite number at the start, and Error{not_converged} where no least sum is found in 200 steps.
CurveFit fit_model(const FitPoints& points, const CurveModel& model, std::span<const FitStart> start,
                   double confidence = 0.95);

// The curve and its interval from `low` to `high`, for drawing: `count` equal steps, and as many equal ratios
// between where both ends are above 0, in ascending order. Points at which the model has no value are left
// out.
std::vector<CurvePoint> sampled_curve(const CurveFit& fit, double low, double high, int count = 100);

}  // namespace asperity
