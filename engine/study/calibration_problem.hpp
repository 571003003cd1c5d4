// SPDX-License-Identifier: GPL-3.0-or-later
// Least-squares problem of a calibration: weighted residuals of rows or specimen means, derivatives by
// differences, and Levenberg–Marquardt on the singular values of the Jacobian. Final differences are central.
// Parameters pushed against a bound are fixed; undetermined directions do not move.
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

// An observation: weight × mean weighted residual over its rows.
struct CalibrationGroup {
  std::vector<std::size_t> rows;
  double weight = 1;
};

struct CalibrationPlace {
  std::vector<double> q;
  std::vector<double> fitted;    // by row
  std::vector<double> roots;     // of row weights
  std::vector<double> residual;  // by observation
  double sum = 0;                // of squares
};

// Jacobian of observations with unit columns.
struct CalibrationTangent {
  std::vector<std::size_t> parameters;
  std::vector<double> lengths;  // of columns
  SingularValues svd;
  std::vector<double> along;  // residuals along each direction
  double offset = 0;          // residuals along the determined directions
  std::size_t rank = 0;
  bool determined(std::size_t k) const { return k < rank; }
};

struct CalibrationMinimum {
  CalibrationPlace place;
  TableColumns rows_jacobian;  // df/dq by row, central
  std::vector<double> scales;
  std::vector<double> differenced_at;  // sparing: place of the differences
  int iterations = 0;
  bool noisy = false;  // ended by model noise
  // Other singular values up to this may stem from errors of rows_jacobian.
  double hidden = 0;
};

// df/dq by row from differences wide enough to agree with another width.
struct FirmSlopes {
  TableColumns rows_jacobian;
  double hidden = 0;
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
  // Expected parameter sets: in all, and after the present part.
  void expect(std::int64_t sets, std::int64_t afterwards) {
    expected_ = calls_ + sets * static_cast<std::int64_t>(rows_.y.size());
    afterwards_ = afterwards * static_cast<std::int64_t>(rows_.y.size());
  }
  void say(std::string part) { part_ = std::move(part); }

  // Nothing without a value in a row; null `roots`: from the weights there.
  std::optional<CalibrationPlace> place(const std::vector<double>& q, const std::vector<double>* roots);
  [[noreturn]] void refuse_place(const std::string& where) const;
  void weigh(CalibrationPlace& place, const std::vector<double>* roots) const;
  TableColumns jacobian(const CalibrationPlace& at, const std::vector<double>& scales,
                        const std::vector<bool>& held, bool central);
  CalibrationTangent tangent(const CalibrationPlace& at, const TableColumns& rows_jacobian,
                             const std::vector<bool>& held, double hidden = 0) const;
  // Of all parameters but those pushed against a bound.
  CalibrationTangent free_tangent(const CalibrationPlace& at, const TableColumns& rows_jacobian) const {
    return tangent(at, rows_jacobian, pushed(at, rows_jacobian, std::vector<bool>(parameters(), false)));
  }
  // By replicate: the model minus its mean over replicates.
  std::vector<std::vector<double>> replicate_deviations(const CalibrationPlace& at);
  // Throws Error{not_converged} if a parameter changes rows only by wide differences, or no parameter changes
  // any row.
  void refuse_still(const CalibrationMinimum& at);
  std::vector<double> observed(const std::vector<double>& of_rows) const;
  double observed_mean(const std::vector<double>& of_rows, std::size_t observation) const;
  // Widens differences until all parameters are determined; otherwise returns the best agreement, if any.
  std::optional<FirmSlopes> firm_slopes(const CalibrationMinimum& at);
  // Fixed parameters, and those pushed against a bound.
  std::vector<bool> pushed(const CalibrationPlace& at, const TableColumns& rows_jacobian,
                           const std::vector<bool>& held) const;
  bool at_lower(double value, std::size_t p) const;
  bool at_upper(double value, std::size_t p) const;
  double inside(double value, std::size_t p) const;

  // `before`: an earlier minimum, for its scales and derivatives; may be empty.
  CalibrationMinimum minimum(const std::vector<double>& start, const CalibrationMinimum& before);
  // Minimum with p fixed as in `start`, and weights and scales of `beside`, to within `gain`; nothing if not
  // reached.
  std::optional<CalibrationPlace> minimum_beside(const CalibrationPlace& start, std::size_t p,
                                                 const CalibrationMinimum& beside, double gain);
  std::string parameters_text(const std::vector<double>& q) const;
  // Throws Error{not_converged}: no step lowers the sum.
  [[noreturn]] void throw_no_lower(const std::vector<double>& q) const;
  // Weighted norm of the data.
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

  // --- sparing fits
  CalibrationMinimum sparing_minimum(CalibrationMinimum found, const CalibrationMinimum& before);
  void take_derivatives(CalibrationMinimum& found, double scatter);
  bool take_first_derivatives(CalibrationMinimum& found, const CalibrationMinimum& before);
  // Returns whether another step is worth while.
  bool full_step(CalibrationMinimum& found, const CalibrationTangent& at, double scatter);
  void move_to(CalibrationPlace next, CalibrationMinimum& found, double scatter, bool scaled);
  std::optional<CalibrationPlace> sparing_beside(const CalibrationPlace& start, std::size_t p,
                                                 const CalibrationMinimum& beside, double gain);
  double scatter_at(const CalibrationPlace& at, const CalibrationTangent& tangent) const;
  std::vector<double> sparing_steps(const CalibrationPlace& at, const TableColumns& rows_jacobian,
                                    const std::vector<double>& scales, double scatter) const;
  TableColumns sparing_jacobian(const CalibrationPlace& at, const std::vector<double>& steps,
                                const std::vector<bool>& held);
  // Predicted residuals.
  std::vector<double> foretold(const CalibrationPlace& at, const TableColumns& rows_jacobian,
                               const std::vector<double>& from, const std::vector<double>& to) const;
  CalibrationPlace foretold_place(const CalibrationMinimum& from, const std::vector<double>& q) const;
  std::optional<CalibrationPlace> lower(CalibrationMinimum& from, double& damping, int& tries);
  void see_noise(const CalibrationMinimum& from, const CalibrationTangent& tangent,
                 const CalibrationPlace& to, double scatter);
  // Singular values up to this, relative to the largest, may stem from differences.
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
  double size_ = 0;          // weighted norm of y
  std::int64_t calls_ = 0, expected_ = 1, afterwards_ = 0;
  // Model values of sparing fits, never recomputed.
  std::vector<std::pair<std::vector<double>, std::vector<double>>> known_;
  double noise_ = 0;        // of an observation, as a sparing fit found it
  double differences_ = 0;  // smallest move of observations by differences
  double share_ = 0;
  std::string part_ = "fit";
  std::size_t without_value_ = 0;
  std::vector<double> without_value_at_;
  std::chrono::steady_clock::time_point begun_, reported_;
};

}  // namespace asperity
