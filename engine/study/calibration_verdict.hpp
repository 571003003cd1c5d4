// SPDX-License-Identifier: GPL-3.0-or-later
// What a calibration says in words: which combination of parameters the rows determine where they do not
// determine each, what stands at a bound, on what the intervals rest and what to measure besides.
#pragma once

#include <vector>

#include "engine/study/calibration.hpp"
#include "engine/study/calibration_problem.hpp"
#include "engine/study/calibration_profile.hpp"

namespace asperity {

// A parameter that the rows push against its bound.
struct CalibrationBound {
  std::size_t parameter = 0;
  double range = 0;           // how far it can leave the bound until S meets the cut
  std::vector<double> moves;  // of all parameters at their best, per unit of this one
  bool decides = false;       // another parameter is not determined, because this one may leave the bound
};

struct CalibrationFindings {
  CalibrationProblem& problem;
  const CalibrationMinimum& at;
  const CalibrationTangent& tangent;
  const TableColumns& covariance;  // for a variance of 1
  const std::vector<bool>& held;   // at a bound
  const std::vector<CalibrationBound>& bounds;
  const std::vector<double>& moved;  // of each parameter by bounds, in half-widths of its own interval
  double variance;                   // of an observation of weight 1, on which intervals rest
  double scatter;                    // the same, as the residuals show it
  double factor;                     // of an interval in standard errors; 0 where no scatter can be seen
  const std::vector<CalibrationProfile>& profiles;
  int begun_again;
  const CalibrationOptions& options;
};

// Sets combinations, identifiable, verdict and warnings. Calls the model where a combination is to be shown.
void add_verdict(Calibration& calibration, const CalibrationFindings& findings);

}  // namespace asperity
