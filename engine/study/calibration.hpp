// SPDX-License-Identifier: GPL-3.0-or-later
// Calibration: the parameters q of a model fitted to measured rows, y_k = f(q, row k) (1 + scatter), by least
// squares, with what the rows do and do not tell of each parameter. Estimates by Levenberg and Marquardt's
// method within bounds, derivatives by differences; linearised intervals with Student's t of n - p degrees,
// and profile likelihood with the cut of the F distribution, S(q_k) = S_min (1 + F(1, n - p)/(n - p)) (Bates
// & Watts 1988, ch. 6). A direction in which no row changes is no estimate: its parameters are given no
// number, and the combination that the rows do determine is told. So is one that a parameter at its bound
// would move far beyond its own interval if it left the bound. With `u` intervals rest on `u`, not on
// residuals. A model may be a mean over replicates, faces of one kind: their scatter moves all rows of a
// specimen together, and that of their mean all rows. Rows of one specimen are repeats: where specimens
// scatter more than their repeats (one-way F test at 50 %), the means of the specimens are the observations,
// with t of m - p degrees. What the model does not describe is not seen.
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

// The model of a row, counted from 0; not a number where there is none. May throw.
using CalibrationModel = std::function<double(std::span<const double> parameters, std::size_t row)>;

// A model that is asked for many rows and sets of parameters at once, and may compute them side by side.
struct CalibrationQuery {
  std::span<const double> parameters;
  std::size_t row = 0;
  std::size_t replicate = 0;  // below CalibrationRows::replicates
};
// The values in the order of the queries, as far as the first that is not finite at least; `done` is told
// now and then how many there are.
using CalibrationBatch = std::function<std::vector<double>(std::span<const CalibrationQuery>,
                                                           const std::function<void(std::size_t)>& done)>;

struct CalibrationParameter {
  std::string name;
  double start = 0;
  std::optional<double> lower, upper;
  // Of the differences, relative to the parameter: well above the noise of the model.
  double step = 1e-3;
  std::string unit{};  // for sentences
};

struct CalibrationRows {
  std::vector<double> y;
  std::vector<double> u{};               // standard uncertainties of y, above 0; none: all alike
  std::vector<double> x{};               // along which residuals are looked at; none: the fitted values
  std::size_t replicates = 1;            // faces over which the model is averaged
  std::vector<std::string> specimens{};  // one a row; none: not known
  std::vector<std::size_t> numbers{};    // what sentences call the rows; none: from 1
  std::vector<std::string> alike{};      // columns that are the same in all rows: "`load` is 5 N"
};

// What scatters alike in all rows: y, or y relative to the model. Relative weights 1/f² are those of the
// fitted values (iterated); values below a thousandth of the largest weigh as if they were that.
enum class CalibrationScatter { absolute, relative };
enum class CalibrationBasis { automatic, rows, specimens };

struct CalibrationOptions {
  CalibrationScatter scatter = CalibrationScatter::absolute;
  CalibrationBasis basis = CalibrationBasis::automatic;
  double confidence = 0.95;
  bool profile = true;
  bool relative_u = false;  // `u` are known but for a common factor, which the residuals tell
  // For a model that takes seconds a row and has a tolerance of its own: the fit ends where a further step
  // would move the estimates by less than a few thousandths of their standard errors, steps of differences
  // move the model by what the rows scatter, and derivatives are corrected from step to step
  // (Broyden 1965) instead of being taken anew: some thirteen sets of two parameters in all.
  bool sparing = false;
};

// (S - S_min)/s² with all other parameters at their best, where this one has this value.
struct ProfilePoint {
  double value = 0, excess = 0;
};

struct CalibratedParameter {
  std::string name;
  bool determined = true;
  std::optional<double> value;  // none where the rows do not determine it
  // None at a bound, where no scatter can be seen, and where a parameter at its bound moves this one.
  std::optional<double> standard_error;
  std::optional<double> low, high;  // linearised; not cut off at bounds
  // Of the profile likelihood; none where it is not asked for, and where it does not fall below the cut.
  std::optional<double> profile_low, profile_high;
  double share_of_faces = 0;                // of the variance, with replicates
  bool at_lower = false, at_upper = false;  // the estimate stands at its bound
  std::vector<ProfilePoint> profile;        // ascending values; empty without a profile
};

struct CalibratedSpecimen {
  std::string name;
  std::size_t rows = 0;
  double residual = 0;  // mean of the residuals in units of their weights: a share with relative scatter
};

struct SpecimenScatter {
  double f = 0;
  std::size_t between = 0, within = 0;  // degrees
  double p_value = 1;
};

struct Calibration {
  std::vector<CalibratedParameter> parameters;
  // Of the estimates; nothing beside parameters that have no standard error.
  std::vector<std::vector<std::optional<double>>> correlation;
  std::optional<double> condition;  // of the Jacobian with columns of length 1; none where it is singular
  std::vector<double> fitted, residuals;                       // of each row: f, y - f
  std::vector<std::optional<double>> fitted_low, fitted_high;  // interval of f, linearised
  std::size_t observations = 0;                                // rows, or specimens
  std::size_t degrees = 0;                                     // of freedom
  bool by_specimens = false;                                   // the observations are means of specimens
  double residual_deviation = 0;                               // of an observation in units of its weight
  double sum_of_squares = 0;
  double cut = 0;  // of ProfilePoint::excess
  std::vector<CalibratedSpecimen> specimens;
  std::optional<SpecimenScatter> specimen_scatter;
  std::vector<std::string> combinations;  // what is determined instead of parameters that are not
  bool identifiable = true;               // every parameter is determined
  std::string verdict;
  std::vector<std::string> warnings;
  double confidence = 0.95;
  int iterations = 0;
  std::int64_t calls = 0;  // of the model
};

// What can be refused before the model is called. Throws Error{bad_value} as calibrate() does.
void check_calibration(const CalibrationRows& rows, std::span<const CalibrationParameter> parameters,
                       const CalibrationOptions& options);

// Same inputs, same bits. The model is called row by row, in order, for each set of parameters: about 2p + 1
// sets a step, and with `sparing` one a step and p at the start and at the end; 4p to 10p more where the
// profile has not shown that derivatives hold. Throws Error{bad_value} for lengths that differ, values that
// are not finite, an `u` not above 0, fewer rows than parameters, bounds that do not hold the start, and a
// model that is no finite number at the start or beside it, naming the row and the parameters;
// Error{infeasible} where specimens are asked for and are no more than the parameters; Error{not_converged};
// and what the model throws. A stop that was asked for ends it between two rows.
Calibration calibrate(const CalibrationRows& rows, const CalibrationModel& model,
                      std::span<const CalibrationParameter> parameters,
                      const CalibrationOptions& options = {}, Monitor& monitor = Monitor::silent());
// The same, of a model that is asked in batches: a set of parameters at a time, and with `sparing` all sets
// of a derivative.
Calibration calibrate(const CalibrationRows& rows, const CalibrationBatch& model,
                      std::span<const CalibrationParameter> parameters, const CalibrationOptions& options,
                      Monitor& monitor);

}  // namespace asperity
