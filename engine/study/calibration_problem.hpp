// SPDX-License-Identifier: GPL-3.0-or-later
// The least squares of a calibration: weighted residuals of rows or of means of specimens, their derivatives
// by differences within bounds, and the least sum by Levenberg and Marquardt's method on the singular values
// of the Jacobian. Differences go forward on the way and are central at the end; a parameter at a bound that
// the rows push against is held there. Directions that no observation sees are left as they are. A sparing
// fit (calibration_sparing.cpp) takes differences at the start and at the end alone. Where a model has steps
// or noise of its own, differences of several widths say how far they can be trusted
// (calibration_firmness.cpp).
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/monitor.hpp"
#include "engine/statistics/least_squares.hpp"
#include "engine/study/calibration.hpp"

namespace asperity {

// Rows that make an observation, and its weight: the observation is weight × mean of their weighted
// residuals.
struct CalibrationGroup {
  std::vector<std::size_t> rows;
  double weight = 1;
};

// A place in the parameters with all that is known of the model there.
struct CalibrationPlace {
  std::vector<double> q;
  std::vector<double> fitted;    // of rows
  std::vector<double> roots;     // of the weights of rows
  std::vector<double> residual;  // of observations
  double sum = 0;                // of their squares
};

// The Jacobian of observations at a place, of some of the parameters, with columns of length 1.
struct CalibrationTangent {
  std::vector<std::size_t> parameters;  // those of its columns
  std::vector<double> lengths;          // of the columns
  SingularValues svd;
  std::vector<double> along;  // of the residuals along each direction
  double offset = 0;          // of the residuals along those that are determined
  std::size_t rank = 0;
  bool determined(std::size_t k) const { return k < rank; }
};

struct CalibrationMinimum {
  CalibrationPlace place;
  TableColumns rows_jacobian;  // df/dq of rows, central
  std::vector<double> scales;
  std::vector<double> differenced_at;  // of a sparing fit: where the differences of rows_jacobian were taken
  int iterations = 0;
  bool noisy = false;  // the model's own noise ended it
  // A singular value of the tangent, beside the largest, that errors of rows_jacobian alone may make.
  double hidden = 0;
};

// df/dq of rows from differences so wide that those of another width agree, as well as they do.
struct FirmSlopes {
  TableColumns rows_jacobian;
  double hidden = 0;  // as in CalibrationMinimum
};

class CalibrationProblem {
 public:
  CalibrationProblem(const CalibrationRows& rows, const CalibrationBatch& model,
                     std::span<const CalibrationParameter> parameters, const CalibrationOptions& options,
                     Monitor& monitor);

  void observe(std::vector<CalibrationGroup> groups) { groups_ = std::move(groups); }
  const std::vector<CalibrationGroup>& groups() const { return groups_; }
  std::size_t parameters() const { return parameters_.size(); }
  const CalibrationParameter& parameter(std::size_t p) const { return parameters_[p]; }
  const CalibrationRows& rows() const { return rows_; }
  std::int64_t calls() const { return calls_; }
  bool sparing() const { return sparing_; }
  // Sets of parameters that are still to be expected, for the progress, and how many of them come after the
  // part of the work that begins here.
  void expect(std::int64_t sets, std::int64_t afterwards) {
    expected_ = calls_ + sets * static_cast<std::int64_t>(rows_.y.size());
    afterwards_ = afterwards * static_cast<std::int64_t>(rows_.y.size());
  }
  void say(std::string part) { part_ = std::move(part); }

  // Nothing where the model has no value in a row; `roots`: none for those of the model there.
  std::optional<CalibrationPlace> place(const std::vector<double>& q, const std::vector<double>* roots);
  // Refuses, naming the row in which the model had no value when place() was last called.
  [[noreturn]] void refuse_place(const std::string& where) const;
  void weigh(CalibrationPlace& place, const std::vector<double>* roots) const;
  TableColumns jacobian(const CalibrationPlace& at, const std::vector<double>& scales,
                        const std::vector<bool>& held, bool central);
  // `hidden`: as in CalibrationMinimum.
  CalibrationTangent tangent(const CalibrationPlace& at, const TableColumns& rows_jacobian,
                             const std::vector<bool>& held, double hidden = 0) const;
  // The model of rows less its mean over the replicates, of each replicate.
  std::vector<std::vector<double>> replicate_deviations(const CalibrationPlace& at);
  // Throws Error{not_converged} where no row changes with a parameter by its difference, but some by a wider
  // one, or where no parameter changes any row.
  void refuse_still(const CalibrationMinimum& at);
  std::vector<double> observed(const std::vector<double>& of_rows) const;
  double observed_mean(const std::vector<double>& of_rows, std::size_t observation) const;
  // Of differences of rising width, the first that tell every parameter, or else those that agree best;
  // nothing where the model has no value beside.
  std::optional<FirmSlopes> firm_slopes(const CalibrationMinimum& at);
  // Parameters that stand at a bound which the residuals push against, and those held before.
  std::vector<bool> pushed(const CalibrationPlace& at, const TableColumns& rows_jacobian,
                           const std::vector<bool>& held) const;
  bool at_lower(double value, std::size_t p) const;
  bool at_upper(double value, std::size_t p) const;
  double inside(double value, std::size_t p) const;

  // `before`: an earlier minimum of the same rows, of which scales and derivatives are taken up; empty where
  // there was none.
  CalibrationMinimum minimum(const std::vector<double>& start, const CalibrationMinimum& before);
  // With parameter p held at its value in `start`, weights as they are and scales known, until what is left
  // to gain of the sum is below `gain`. `beside`: the least sum of all. Nothing where it does not get there.
  std::optional<CalibrationPlace> minimum_beside(const CalibrationPlace& start, std::size_t p,
                                                 const CalibrationMinimum& beside, double gain);
  std::string parameters_text(const std::vector<double>& q) const;
  // Throws Error{not_converged}: no step from here makes the sum less, and the derivatives say one should.
  [[noreturn]] void throw_no_lower(const std::vector<double>& q) const;
  // Of the data as the weights there count them.
  double size_of(const CalibrationPlace& at) const;

 private:
  std::optional<std::vector<double>> fitted(const std::vector<double>& q);
  std::vector<std::optional<std::vector<double>>> fitted_all(const std::vector<std::vector<double>>& sets);
  std::vector<double> asked(const std::vector<std::vector<double>>& sets);
  std::vector<double> natural_scales(const CalibrationPlace& at);
  std::optional<std::vector<double>> slopes(const CalibrationPlace& at, std::size_t p, double step,
                                            bool central);
  std::vector<double> stepped(const CalibrationPlace& at, const CalibrationTangent& tangent,
                              double damping) const;
  std::optional<CalibrationPlace> better(const CalibrationPlace& at, const CalibrationTangent& tangent,
                                         const std::vector<double>* roots, double& damping);

  // --- of a sparing fit
  CalibrationMinimum sparing_minimum(const std::vector<double>& start, const CalibrationMinimum& before);
  std::optional<CalibrationPlace> sparing_beside(const CalibrationPlace& start, std::size_t p,
                                                 const CalibrationMinimum& beside, double gain);
  double scatter_at(const CalibrationPlace& at, const CalibrationTangent& tangent) const;
  std::vector<double> sparing_steps(const CalibrationPlace& at, const TableColumns& rows_jacobian,
                                    const std::vector<double>& scales, double scatter) const;
  TableColumns sparing_jacobian(const CalibrationPlace& at, const std::vector<double>& steps,
                                const std::vector<bool>& held);
  // Of the observations, as the derivatives foretell it between two places.
  std::vector<double> foretold(const CalibrationPlace& at, const TableColumns& rows_jacobian,
                               const std::vector<double>& from, const std::vector<double>& to) const;
  CalibrationPlace foretold_place(const CalibrationMinimum& from, const std::vector<double>& q) const;
  std::optional<CalibrationPlace> lower(CalibrationMinimum& from, double& damping, int& tries);
  void see_noise(const CalibrationMinimum& from, const CalibrationTangent& tangent,
                 const CalibrationPlace& to, double scatter);
  // A singular value, relative to the largest, that errors of differences alone may make.
  double sparing_unseen() const;
  void correct(TableColumns& rows_jacobian, const CalibrationPlace& from, const CalibrationPlace& to,
               const std::vector<double>& scales) const;

  void report(std::int64_t calls);

  const CalibrationRows& rows_;
  const CalibrationBatch& model_;
  std::span<const CalibrationParameter> parameters_;
  CalibrationScatter scatter_;
  bool sparing_;
  Monitor& monitor_;
  std::vector<CalibrationGroup> groups_;
  std::vector<double> own_;  // 1/u
  double size_ = 0;          // of the weighted y
  std::int64_t calls_ = 0, expected_ = 1, afterwards_ = 0;
  // Of a sparing fit, so that no set of parameters is asked for twice.
  std::vector<std::pair<std::vector<double>, std::vector<double>>> known_;
  double noise_ = 0;        // of an observation of the model, as far as a sparing fit has seen
  double differences_ = 0;  // by how much those of a sparing fit move the observations at least
  double share_ = 0;
  std::string part_ = "fit";
  std::size_t without_value_ = 0;  // row
  std::vector<double> without_value_at_;
  std::chrono::steady_clock::time_point begun_, reported_;
};

}  // namespace asperity
