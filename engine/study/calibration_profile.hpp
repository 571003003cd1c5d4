// SPDX-License-Identifier: GPL-3.0-or-later
// The profile likelihood of one parameter of a calibration: with the others at their best, S grows to either
// side of the estimate; the interval ends where it meets the cut. sqrt(S - S_min) is nearly straight in the
// parameter, so that a few places suffice (Bates & Watts 1988, ch. 6); where the model is straight as well,
// the place that the derivatives foretell is taken as it is, at the cost of one set of parameters an end.
#pragma once

#include <optional>
#include <vector>

#include "engine/study/calibration_problem.hpp"

namespace asperity {

struct CalibrationProfile {
  std::optional<double> low, high;  // none where S stays below the cut as far as it was followed
  bool low_at_bound = false, high_at_bound = false;  // it does so to the bound
  std::vector<ProfilePoint> points;                  // ascending; excess in units of `scatter`²
  // Parameters where S is less than at the least sum that was found, if any.
  std::optional<std::vector<double>> lower_sum;
  // At its first places the model did what its derivatives foretell, but for curvature.
  bool as_foretold = false;
};

// `guide`: how all parameters move with this one along the valley of S, with 1 for itself; `reach`: how far
// the end is expected; `cut`: S - S_min at an end; `scatter`: the variance of an observation of weight 1.
CalibrationProfile profile_of(CalibrationProblem& problem, const CalibrationMinimum& at, std::size_t p,
                              const std::vector<double>& guide, double reach, double cut, double scatter);

}  // namespace asperity
