// SPDX-License-Identifier: GPL-3.0-or-later
// Growth of slip while a tilt stage is raised. At the angle θ the weight W presses by W cos θ and pulls by W
// sin θ, tan θ/μ of the sliding force; partial slip (friction/partial_slip.hpp) gives the slipping share of
// the contact. The law is Coulomb's, with the mean μ of the junction law. On a half-space the share at the
// first probe pressure is assumed down to the weight.
#pragma once

#include "engine/specimen/tilt_trials.hpp"

namespace asperity {

struct SlipShare {
  double angle = 0;          // rad
  double ratio = 0;          // pull over sliding force, 0 … 1
  double slip_fraction = 0;  // of the contact area
  // m, between the bodies; none on a half-space.
  std::optional<double> displacement{};
};

// At `steps` (1 … 10000) equal steps up to slip, or the limit. Ignores scatter and repeats. Works on a copy.
// Throws as raise() and shear() do.
std::vector<SlipShare> slip_growth(const SpecimenPair& pair, const JunctionLaw& law,
                                   const TiltTrialOptions& options, int steps,
                                   Monitor& monitor = Monitor::silent());

}  // namespace asperity
