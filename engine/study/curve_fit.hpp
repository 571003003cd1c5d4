// SPDX-License-Identifier: GPL-3.0-or-later
// Fit of y = f(x, q) to points (calibrate.hpp), for a line, a power law or any function, with a pointwise
// interval; x is exact. Lines and power laws are fitted about the middle of the points, where their
// parameters are nearly independent.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "engine/run/notebook_chart.hpp"
#include "engine/study/calibrate.hpp"

namespace asperity {

// NaN outside its domain.
using CurveModel = std::function<double(double x, std::span<const double> parameters)>;
// With further columns: value in a row of points.
using RowModel = std::function<double(std::size_t row, std::span<const double> parameters)>;

struct CurveFit {
  Calibration found;
  std::optional<double> r_squared;  // 1 - S/Σ w (y - mean)²; none for equal y
  std::vector<CurvePoint> curve;    // over the range of x, ascending
};

// Points are rows.x and rows.y. All throw errors of calibrate(), Error{bad_value} for an x that is not finite
// or fewer points than parameters + 1 (parameters, with known `u`), Error{infeasible} for undetermined
// parameters.
CurveFit fit_line(const CalibrationRows& rows, const CalibrationOptions& options = {});
// y = a x^b by least squares of y, started from logarithms. Also throws Error{bad_value} for x below 0 and
// Error{infeasible} for fewer than two usable x.
CurveFit fit_power(const CalibrationRows& rows, const CalibrationOptions& options = {});
CurveFit fit_model(const CalibrationRows& rows, const CurveModel& model,
                   std::vector<CalibrationParameter> parameters, const CalibrationOptions& options = {},
                   const RowModel& in_row = nullptr);

}  // namespace asperity
