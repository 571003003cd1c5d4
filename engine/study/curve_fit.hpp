// SPDX-License-Identifier: GPL-3.0-or-later
// A curve y = f(x, q) through measured points: a calibration (calibration.hpp) of a straight line, a power
// law or any function of x, and the curve with its pointwise interval for drawing. Line and power law are
// fitted about the middle of the points, where their parameters are nearly independent, and then expressed at
// x = 0 and x = 1. Here parameters that the points do not determine are an error. x is taken as exact.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "engine/run/notebook_chart.hpp"
#include "engine/study/calibration.hpp"

namespace asperity {

// The value at x with these parameters; not a number where there is none.
using CurveModel = std::function<double(double x, std::span<const double> parameters)>;

struct CurveFit {
  Calibration found;
  std::optional<double> r_squared;  // 1 - S/Σ w (y - mean)²; none where every y is the same
  std::vector<CurvePoint> curve;    // over the range of x, ascending, without points that have no value
};

// The points are rows.x and rows.y. All throw as calibrate() does, besides Error{bad_value} for an x that is
// not finite and for fewer points than parameters + 1 without a known `u`, and Error{infeasible} naming the
// parameters that the points do not determine.
CurveFit fit_line(const CalibrationRows& rows, const CalibrationOptions& options = {});
// y = a x^b by least squares of y itself, begun from the straight line through the logarithms. Throws besides
// Error{bad_value} for x below 0, and where fewer than two points of different x have x and y that begin it.
CurveFit fit_power(const CalibrationRows& rows, const CalibrationOptions& options = {});
// Any function, begun from the starts of the parameters.
CurveFit fit_model(const CalibrationRows& rows, const CurveModel& model,
                   std::vector<CalibrationParameter> parameters, const CalibrationOptions& options = {});

}  // namespace asperity
