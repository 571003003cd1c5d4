// SPDX-License-Identifier: GPL-3.0-or-later
// Expected transforms of a half-space press from a trial on all cells, if cheap, or on fewer. The count P of
// the trial scales to
//   T = P 2^(l (a + b s)),   l = ½ log2(nodes / nodes tried),   s² = ⟨(h_k − h_k+1)²⟩ / (2 ⟨(h − ⟨h⟩)²⟩),
// with l halvings of each side and s <= 1 the share of heights in waves of a few cells along the rougher side
// (white noise 1, smooth surfaces 0). a, b depend on the prescribed quantity. T is exact after a trial on all
// cells. Trials leave cost counters, laws and contacts unchanged. Accuracy of T:
// tests/stability/properties/explain.cpp.
#pragma once

#include <limits>
#include <string>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/scene/press_request.hpp"
#include "engine/contact/scene/scene.hpp"

namespace asperity {

struct ExpectedTransforms {
  double transforms = 0;  // T, transforms of the finest grid
  Grid tried_on;
  double tried = 0;      // P, transforms of `tried_on`
  bool ended = true;     // converged; a stopped trial may make T far too small
  std::string refused;   // reason; T is then the estimate for a press by pressure
  double halvings = 0;   // l
  double roughness = 0;  // s
  double work = 0;       // of the trial, transforms of the finest grid
};

// About the same shape. Returns `grid` itself if small enough.
Grid trial_grid(const Grid& grid, double most_nodes);

struct TrialEffort {
  // Per trial, in units of transform_work: 0.25 s on one core, 476 transforms of 256² cells or 106 of 512².
  double work = 5e8;
  // Limit for tests of the extrapolation.
  double most_nodes = std::numeric_limits<double>::infinity();
};

// O(nodes) plus the trial. Throws as check(request).
ExpectedTransforms expected_transforms(const Scene& scene, const ContactGeometry& geometry, const Plan& plan,
                                       const PressRequest& request, const TrialEffort& effort = {});

// `plan` with transforms, time and sentence of this press.
Plan plan_of_press(const Scene& scene, const ContactGeometry& geometry, const Plan& plan,
                   const PressRequest& request);

}  // namespace asperity
