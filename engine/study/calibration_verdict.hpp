// SPDX-License-Identifier: GPL-3.0-or-later
// Verdict of a calibration: determined combinations, parameters at bounds, the basis of intervals and useful
// measurements.
#pragma once

#include <vector>

#include "engine/study/calibration.hpp"
#include "engine/study/calibration_problem.hpp"
#include "engine/study/calibration_profile.hpp"

namespace asperity {

struct CalibrationBound {
  std::size_t parameter = 0;
  double range = 0;           // until S meets the cut
  std::vector<double> moves;  // of every parameter, per unit of this
  bool decides = false;       // makes another parameter undetermined
};

struct CalibrationFindings {
  CalibrationProblem& problem;
  const CalibrationMinimum& at;
  const CalibrationTangent& tangent;
  const TableColumns& covariance;  // for unit variance
  const std::vector<bool>& held;   // at a bound
  const std::vector<CalibrationBound>& bounds;
  const std::vector<double>& moved;  // by bounds, in half-widths
  double variance;                   // at unit weight, for intervals
  double scatter;                    // the same, from residuals
  double factor;                     // interval in standard errors; 0 without scatter
  const std::vector<CalibrationProfile>& profiles;
  int begun_again;
  const CalibrationOptions& options;
};

// Sets combinations, identifiable, verdict and warnings. May call the model.
void add_verdict(Calibration& calibration, const CalibrationFindings& findings);

}  // namespace asperity
