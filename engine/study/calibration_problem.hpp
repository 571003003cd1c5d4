// SPDX-License-Identifier: GPL-3.0-or-later
// The least squares of a calibration: weighted residuals of rows or of means of specimens, their derivatives
// by differences within bounds, and the least sum by Levenberg and Marquardt's method on the singular values
// of the Jacobian. Differences go forward on the way and are central at the end; a parameter at a bound that
// the rows push against is held there. Directions that no observation sees are left as they are.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
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
  int iterations = 0;
  bool noisy = false;  // the model's own noise ended it
};

class CalibrationProblem {
 public:
  CalibrationProblem(const CalibrationRows& rows, const CalibrationModel& model,
                     std::span<const CalibrationParameter> parameters, CalibrationScatter scatter,
                     Monitor& monitor);

  void observe(std::vector<CalibrationGroup> groups) { groups_ = std::move(groups); }
  const std::vector<CalibrationGroup>& groups() const { return groups_; }
  std::size_t parameters() const { return parameters_.size(); }
  const CalibrationParameter& parameter(std::size_t p) const { return parameters_[p]; }
  const CalibrationRows& rows() const { return rows_; }
  std::int64_t calls() const { return calls_; }
  // Sets of parameters that are still to be expected, for the progress.
  void expect(std::int64_t sets) { expected_ = calls_ + sets * static_cast<std::int64_t>(rows_.y.size()); }
  void say(std::string part) { part_ = std::move(part); }

  // Nothing where the model has no value in a row; `roots`: none for those of the model there.
  std::optional<CalibrationPlace> place(const std::vector<double>& q, const std::vector<double>* roots);
  // Refuses, naming the row in which the model had no value when place() was last called.
  [[noreturn]] void refuse_place(const std::string& where) const;
  void weigh(CalibrationPlace& place, const std::vector<double>* roots) const;
  TableColumns jacobian(const CalibrationPlace& at, const std::vector<double>& scales,
                        const std::vector<bool>& held, bool central);
  CalibrationTangent tangent(const CalibrationPlace& at, const TableColumns& rows_jacobian,
                             const std::vector<bool>& held) const;
  // Parameters that stand at a bound which the residuals push against, and those held before.
  std::vector<bool> pushed(const CalibrationPlace& at, const TableColumns& rows_jacobian,
                           const std::vector<bool>& held) const;
  bool at_lower(double value, std::size_t p) const;
  bool at_upper(double value, std::size_t p) const;
  double inside(double value, std::size_t p) const;

  // `scales`: of the parameters, as an earlier minimum left them; empty where there was none.
  CalibrationMinimum minimum(const std::vector<double>& start, const std::vector<double>& scales);
  // With parameter p held at its value in `start`, weights as they are and scales known, until what is left
  // to gain of the sum is below `gain`. Nothing where it does not get there.
  std::optional<CalibrationPlace> minimum_beside(const CalibrationPlace& start, std::size_t p,
                                                 const std::vector<double>& roots,
                                                 const std::vector<double>& scales, double gain);
  std::string parameters_text(const std::vector<double>& q) const;
  // Of the data as the weights there count them.
  double size_of(const CalibrationPlace& at) const;

 private:
  std::optional<std::vector<double>> fitted(const std::vector<double>& q);
  std::vector<double> observed(const std::vector<double>& of_rows) const;
  std::vector<double> natural_scales(const CalibrationPlace& at);
  std::optional<std::vector<double>> slopes(const CalibrationPlace& at, std::size_t p, double step,
                                            bool central);
  std::optional<CalibrationPlace> better(const CalibrationPlace& at, const CalibrationTangent& tangent,
                                         const std::vector<double>* roots, double& damping);
  void report();

  const CalibrationRows& rows_;
  const CalibrationModel& model_;
  std::span<const CalibrationParameter> parameters_;
  CalibrationScatter scatter_;
  Monitor& monitor_;
  std::vector<CalibrationGroup> groups_;
  std::vector<double> own_;  // 1/u
  double size_ = 0;          // of the weighted y
  std::int64_t calls_ = 0, expected_ = 1;
  double share_ = 0;
  std::string part_ = "fit";
  std::size_t without_value_ = 0;  // row
  std::vector<double> without_value_at_;
  std::chrono::steady_clock::time_point begun_, reported_;
};

}  // namespace asperity
