// SPDX-License-Identifier: GPL-3.0-or-later
// Profile likelihood: S, minimised over the other parameters; the interval ends at the cut. sqrt(S - S_min)
// is nearly linear, so a few places suffice (Bates & Watts 1988, ch. 6). A linear model costs one parameter
// set per end.
#pragma once

#include <optional>
#include <vector>

#include "engine/study/calibration_problem.hpp"

namespace asperity {

struct CalibrationProfile {
  std::optional<double> low, high;                   // none if S stays below the cut
  bool low_at_bound = false, high_at_bound = false;  // up to the bound
  std::vector<ProfilePoint> points;                  // ascending; excess in `scatter`²
  // A sum below the supposed minimum, if found.
  std::optional<std::vector<double>> lower_sum;
  // The first places confirmed the derivatives, apart from curvature.
  bool as_foretold = false;
};

// `guide`: moves of the parameters along the valley, 1 for p; `reach`: expected end; `cut`: S - S_min there;
// `scatter`: variance at unit weight.
CalibrationProfile profile_of(CalibrationProblem& problem, const CalibrationMinimum& at, std::size_t p,
                              const std::vector<double>& guide, double reach, double cut, double scatter);

}  // namespace asperity
