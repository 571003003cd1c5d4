// SPDX-License-Identifier: GPL-3.0-or-later
// How slip grows inside the contact while a tilt stage is raised, long before the specimen slides: at the
// angle θ the weight W presses by W cos θ and pulls by W sin θ, which is tan θ/μ of what slides, and partial
// slip (friction/partial_slip.hpp) tells which part of the contact slips there. Slip takes Coulomb's law: a
// junction law with an adhesive part stands for its mean coefficient on the contact, μ. On a half-space the
// share is found at the first probe pressure and, as the stage does, taken to hold down to the weight.
#pragma once

#include "engine/specimen/tilt_trials.hpp"

namespace asperity {

struct SlipShare {
  double angle = 0;          // rad
  double ratio = 0;          // of the pull over the one that slides, 0 … 1
  double slip_fraction = 0;  // of the contact area
  // m, of the bodies over each other; none on a half-space, where it is not that of the weight.
  std::optional<double> displacement{};
};

// At `steps` (1 … 10000) equal steps of the angle up to the one at which the first trial slips, or the limit.
// Scatter and repeats are not read. Works on a copy. Throws what raise() and shear() throw.
std::vector<SlipShare> slip_growth(const SpecimenPair& pair, const JunctionLaw& law,
                                   const TiltTrialOptions& options, int steps,
                                   Monitor& monitor = Monitor::silent());

}  // namespace asperity
