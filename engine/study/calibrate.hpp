// SPDX-License-Identifier: GPL-3.0-or-later
// Calibration: least-squares fit of parameters q to measured rows, y_k = f(q, row k) (1 + scatter), by
// Levenberg–Marquardt within bounds. Intervals: linearised with Student's t of n − p degrees, and profile
// likelihood with the F cut S(q_k) = S_min (1 + F(1, n − p)/(n − p)) (Bates & Watts 1988, ch. 6). With `u`,
// intervals rest on `u`, not on residuals. Undetermined parameters, including those that move far beyond
// their interval if another leaves its bound, get no number; the determined combination is reported. If
// specimens scatter more than their repeats (one-way F test at 50 %), specimen means are the observations,
// with t of m − p degrees. Systematic model errors are not included.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/monitor.hpp"

namespace asperity {

// Row from 0; NaN without a value. May throw.
using CalibrationModel = std::function<double(std::span<const double> parameters, std::size_t row)>;

struct CalibrationQuery {
  std::span<const double> parameters;
  std::size_t row = 0;
  std::size_t replicate = 0;  // below CalibrationRows::replicates
};
// Values in query order, up to the first that is not finite or further. Calls `done` with their number.
using CalibrationBatch = std::function<std::vector<double>(std::span<const CalibrationQuery>,
                                                           const std::function<void(std::size_t)>& done)>;

struct CalibrationParameter {
  std::string name;
  double start = 0;
  std::optional<double> lower, upper;
  // Relative difference, well above the model noise.
  double step = 1e-3;
  std::string unit{};  // for messages
};

struct CalibrationRows {
  std::vector<double> y;
  std::vector<double> u{};               // standard uncertainties, above 0; none: equal
  std::vector<double> x{};               // for residuals; none: fitted values
  std::size_t replicates = 1;            // faces; the model averages
  std::vector<std::string> specimens{};  // per row; none: unknown
  std::vector<std::size_t> numbers{};    // in messages; none: from 1
  std::vector<std::string> alike{};      // constant columns: "`load` is 5 N"
};

// Scatter of y, or of y/f. Weights 1/f² use fitted values, at least 1/1000 of the largest.
enum class CalibrationScatter { absolute, relative };
enum class CalibrationBasis { automatic, rows, specimens };

struct CalibrationOptions {
  CalibrationScatter scatter = CalibrationScatter::absolute;
  CalibrationBasis basis = CalibrationBasis::automatic;
  double confidence = 0.95;
  bool profile = true;
  bool relative_u = false;  // factor of `u` from residuals
  // For models of seconds per row with their own tolerance (calibration_sparing.cpp). The fit stops below a
  // few thousandths of the standard errors.
  bool sparing = false;
};

// (S - S_min)/s², minimised over the others.
struct ProfilePoint {
  double value = 0, excess = 0;
};

struct CalibratedParameter {
  std::string name;
  bool determined = true;
  std::optional<double> value;  // none if undetermined
  // None at a bound, without scatter, or moved by another bound.
  std::optional<double> standard_error;
  std::optional<double> low, high;  // linearised, beyond bounds
  // None if not requested or below the cut.
  std::optional<double> profile_low, profile_high;
  double share_of_faces = 0;  // of variance, with replicates
  bool at_lower = false, at_upper = false;
  std::vector<ProfilePoint> profile;  // ascending; may be empty
};

struct CalibratedSpecimen {
  std::string name;
  std::size_t rows = 0;
  double residual = 0;  // mean, in units of weights
};

struct SpecimenScatter {
  double f = 0;
  std::size_t between = 0, within = 0;  // degrees
  double p_value = 1;
};

struct Calibration {
  std::vector<CalibratedParameter> parameters;
  // Nothing without standard errors.
  std::vector<std::vector<std::optional<double>>> correlation;
  std::optional<double> condition;                             // unit columns; none if singular
  std::vector<double> fitted, residuals;                       // per row: f, y - f
  std::vector<std::optional<double>> fitted_low, fitted_high;  // linearised
  std::size_t observations = 0;                                // rows or specimens
  std::size_t degrees = 0;
  bool by_specimens = false;      // observations are specimen means
  double residual_deviation = 0;  // in units of weights
  double sum_of_squares = 0;
  double cut = 0;  // of ProfilePoint::excess
  std::vector<CalibratedSpecimen> specimens;
  std::optional<SpecimenScatter> specimen_scatter;
  std::vector<std::string> combinations;  // determined instead of single parameters
  bool identifiable = true;               // all parameters determined
  std::string verdict;
  std::vector<std::string> warnings;
  double confidence = 0.95;
  int iterations = 0;
  std::int64_t calls = 0;  // of the model
};

// Throws the errors of calibrate() that need no model.
void check_calibration(const CalibrationRows& rows, std::span<const CalibrationParameter> parameters,
                       const CalibrationOptions& options);

// Reproducible to the bit. Calls the model row by row: about 2p + 1 parameter sets per step; with `sparing`
// one per step and p at start and end; 4p to 10p more if the profile does not confirm the derivatives. Throws
// Error{bad_value} for contradictory arguments and for a model without a value near the start, naming row and
// parameters; Error{infeasible} if requested specimens do not exceed the parameters; Error{not_converged};
// errors of the model; and at a stop.
Calibration calibrate(const CalibrationRows& rows, const CalibrationModel& model,
                      std::span<const CalibrationParameter> parameters,
                      const CalibrationOptions& options = {}, Monitor& monitor = Monitor::silent());
// Batch: a parameter set or, with `sparing`, all of a derivative.
Calibration calibrate(const CalibrationRows& rows, const CalibrationBatch& model,
                      std::span<const CalibrationParameter> parameters, const CalibrationOptions& options,
                      Monitor& monitor);

}  // namespace asperity
