// SPDX-License-Identifier: GPL-3.0-or-later
// Least-squares problem of a calibration: weighted residuals of rows or specimen means, derivatives by
// differences (at last central), and Levenberg–Marquardt on the singular values of the Jacobian. Parameters
// pushed against a bound are fixed; undetermined directions do not move.
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
#include "engine/study/calibrate.hpp"

namespace asperity {

// Weight × mean weighted residual over its rows.
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
  std::vector<double> along;  // residuals by direction
  double offset = 0;          // residuals in determined directions
  std::size_t rank = 0;
};

struct CalibrationMinimum {
  CalibrationPlace place;
  TableColumns rows_jacobian;  // df/dq by row, central
  std::vector<double> scales;
  std::vector<double> differenced_at;  // sparing: origin of differences
  int iterations = 0;
  bool noisy = false;  // ended by model noise
  // Errors of rows_jacobian may cause other singular values up to this.
  double hidden = 0;
};

// From differences wide enough to agree with another width.
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
  // Parameter sets: in all, and after the present part.
  void expect(std::int64_t sets, std::int64_t afterwards) {
    expected_ = calls_ + sets * static_cast<std::int64_t>(rows_.y.size());
    afterwards_ = afterwards * static_cast<std::int64_t>(rows_.y.size());
  }
  void say(std::string part) { part_ = std::move(part); }

  // Nothing if a row has no value; null `roots`: from the weights there.
  std::optional<CalibrationPlace> place(const std::vector<double>& q, const std::vector<double>* roots);
  [[noreturn]] void refuse_place(const std::string& where) const;
  void weigh(CalibrationPlace& place, const std::vector<double>* roots) const;
  TableColumns jacobian(const CalibrationPlace& at, const std::vector<double>& scales,
                        const std::vector<bool>& held, bool central);
  CalibrationTangent tangent(const CalibrationPlace& at, const TableColumns& rows_jacobian,
                             const std::vector<bool>& held, double hidden = 0) const;
  // Without parameters pushed against a bound.
  CalibrationTangent free_tangent(const CalibrationPlace& at, const TableColumns& rows_jacobian) const {
    return tangent(at, rows_jacobian, pushed(at, rows_jacobian, std::vector<bool>(parameters(), false)));
  }
  // By replicate, relative to the mean.
  std::vector<std::vector<double>> replicate_deviations(const CalibrationPlace& at);
  // Throws Error{not_converged} if a parameter changes rows only by wide differences, or none changes any
  // row.
  void refuse_still(const CalibrationMinimum& at);
  std::vector<double> observed(const std::vector<double>& of_rows) const;
  // For rows with the weights of `at`.
  std::vector<double> observed(const CalibrationPlace& at, const std::vector<double>& of_rows) const;
  std::vector<double> weighted_residuals(const CalibrationPlace& at) const;
  double observed_mean(const std::vector<double>& of_rows, std::size_t observation) const;
  // Widens differences until all parameters are determined; else the best agreement, if any.
  std::optional<FirmSlopes> firm_slopes(const CalibrationMinimum& at);
  // Fixed parameters, and those pushed against a bound.
  std::vector<bool> pushed(const CalibrationPlace& at, const TableColumns& rows_jacobian,
                           const std::vector<bool>& held) const;
  bool at_lower(double value, std::size_t p) const;
  bool at_upper(double value, std::size_t p) const;
  double inside(double value, std::size_t p) const;

  // `before`: an earlier minimum, for scales and derivatives, or empty.
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
  // False if no further step is worth while.
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
  // Relative to the largest; differences may cause smaller singular values.
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
  double noise_ = 0;        // seen by a sparing fit
  double differences_ = 0;  // smallest move by differences
  double share_ = 0;
  std::string part_ = "fit";
  std::size_t without_value_ = 0;
  std::vector<double> without_value_at_;
  std::chrono::steady_clock::time_point begun_, reported_;
};

// Profile likelihood: S, minimised over the other parameters; the interval ends at the cut. sqrt(S - S_min)
// is nearly linear, so a few places suffice (Bates & Watts 1988, ch. 6). A linear model costs one parameter
// set per end.
struct CalibrationProfile {
  std::optional<double> low, high;                   // none below the cut
  bool low_at_bound = false, high_at_bound = false;  // up to the bound
  std::vector<ProfilePoint> points;                  // ascending; excess in `scatter`²
  // A sum below the supposed minimum, if found.
  std::optional<std::vector<double>> lower_sum;
  // Up to curvature, by the first places.
  bool as_foretold = false;
};

// `guide`: moves of the parameters along the valley, 1 for p; `reach`: expected end; `cut`: S - S_min there;
// `scatter`: variance at unit weight.
CalibrationProfile profile_of(CalibrationProblem& problem, const CalibrationMinimum& at, std::size_t p,
                              const std::vector<double>& guide, double reach, double cut, double scatter);

// Verdict of a calibration: determined combinations, parameters at bounds, useful measurements.

struct CalibrationBound {
  std::size_t parameter = 0;
  double range = 0;           // to the cut of S
  std::vector<double> moves;  // all parameters, per unit
  bool decides = false;       // another becomes undetermined
};

struct CalibrationFindings {
  CalibrationProblem& problem;
  const CalibrationMinimum& at;
  const CalibrationTangent& tangent;
  const TableColumns& covariance;  // for unit variance
  const std::vector<bool>& held;   // at a bound
  const std::vector<CalibrationBound>& bounds;
  const std::vector<double>& moved;  // by bounds, in half-widths
  double variance;                   // unit weight, for intervals
  double scatter;                    // unit weight, from residuals
  double factor;                     // in standard errors; 0 without scatter
  const std::vector<CalibrationProfile>& profiles;
  int begun_again;
  const CalibrationOptions& options;
};

// Sets combinations, identifiable, verdict and warnings. May call the model.
void add_verdict(Calibration& calibration, const CalibrationFindings& findings);

}  // namespace asperity
