// SPDX-License-Identifier: GPL-3.0-or-later
// Expected transforms of a half-space press, from a trial press: on all cells if that is cheap, otherwise on
// fewer. The count P of the trial is scaled to the grid by
//   T = P 2^(l (a + b s)),   l = ½ log2(nodes / nodes tried),   s² = ⟨(h_k − h_k+1)²⟩ / (2 ⟨(h − ⟨h⟩)²⟩),
// where l is the number of halvings of each side and s <= 1 the share of heights in waves of a few cells,
// along the rougher side: 1 for white noise, near 0 for smooth surfaces. a and b depend on the prescribed
// quantity. After a trial on all cells, T is exact. A trial changes no cost counter, no law and no contact.
// Accuracy of T: tests/stability/properties/explain.cpp; constants: the source.
#pragma once

#include <limits>
#include <string>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/press_request.hpp"
#include "engine/contact/scene.hpp"

namespace asperity {

struct ExpectedTransforms {
  double transforms = 0;  // T, in transforms of the finest grid
  Grid tried_on;
  double tried = 0;      // P, in transforms of `tried_on`
  bool ended = true;     // the trial converged; otherwise it was stopped, and T may be far too small
  std::string refused;   // why the trial was refused; T is then that of a press by pressure
  double halvings = 0;   // l
  double roughness = 0;  // s
  double work = 0;       // of the trial, in transforms of the finest grid
};

// Cells of about the same shape with at most `most_nodes` nodes; `grid` itself if small enough.
Grid trial_grid(const Grid& grid, double most_nodes);

// Effort of trials. They begin with about 96² nodes and end with the nodes that the work allows, or 1/32 of
// all if more.
struct TrialEffort {
  // Of one trial, in units of transform_work: about 0.25 s on one core, 476 transforms of 256² cells or 106
  // of 512².
  double work = 5e8;
  // Maximum nodes of a trial; for tests of the extrapolation.
  double most_nodes = std::numeric_limits<double>::infinity();
};

// For the bodies in their places in `geometry` and their `plan`. O(nodes) plus the trial press. Throws as
// check(request).
ExpectedTransforms expected_transforms(const Scene& scene, const ContactGeometry& geometry, const Plan& plan,
                                       const PressRequest& request, const TrialEffort& effort = {});

// `plan` with the transforms and the time of this press, and a sentence that states both.
Plan plan_of_press(const Scene& scene, const ContactGeometry& geometry, const Plan& plan,
                   const PressRequest& request);

}  // namespace asperity
