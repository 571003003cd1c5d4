// SPDX-License-Identifier: GPL-3.0-or-later
// How many transforms a press of half-spaces will take, before it is made: the very press is tried, on all
// cells where that is little work and on fewer otherwise, whose count P is carried to the cells given,
//   T = P 2^(l (a + b s)),   l = ½ log2(nodes / nodes tried),   s² = ⟨(h_k − h_k+1)²⟩ / (2 ⟨(h − ⟨h⟩)²⟩),
// l the times each side was halved and s <= 1 the share of the heights that lies in waves of a few cells,
// along the rougher side: 1 of white noise, next to nothing of smooth ground. a and b are of the quantity
// that is prescribed. A press tried on all cells takes what the trial took, to the last transform. What is
// tried and thrown away changes nothing: no counter of costs, no law met, no contact. How often T holds is at
// the head of tests/stability/properties/explain.cpp; constants, and the command that fits them again, are at
// the head of the source.
#pragma once

#include <limits>
#include <string>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/scene/press_request.hpp"
#include "engine/contact/scene/scene.hpp"

namespace asperity {

struct ExpectedTransforms {
  double transforms = 0;  // T, equivalents of the finest grid
  Grid tried_on;
  double tried = 0;      // P, equivalents of `tried_on`
  bool ended = true;     // the trial came to an answer; otherwise it was left, and T may be more by far
  std::string refused;   // why it was refused on so few cells; T is then that of a press by pressure
  double halvings = 0;   // l
  double roughness = 0;  // s
  double work = 0;       // what trying it took, equivalents of the finest grid
};

// Cells of about the same shape, at most so many nodes of them; `grid` itself where it has no more.
Grid trial_grid(const Grid& grid, double most_nodes);

// How far trials go. They begin on some 96² nodes and end on as many as the work of one leaves room for, or a
// 32nd of all if that is more.
struct TrialEffort {
  // Of one trial, as transform_work counts it: some quarter of a second on one core, 476 transforms of 256²
  // cells or 106 of 512².
  double work = 5e8;
  // On no more than so many: for whoever asks how well few cells tell of many.
  double most_nodes = std::numeric_limits<double>::infinity();
};

// Of a half-space pressed as `request` says, for the bodies as they lie in `geometry`, with what `plan`,
// which is theirs, remembers. O(nodes) and the press on the trial's cells. Throws what check(request) throws.
ExpectedTransforms expected_transforms(const Scene& scene, const ContactGeometry& geometry, const Plan& plan,
                                       const PressRequest& request, const TrialEffort& effort = {});

// `plan` with the transforms and the time of this press and the sentence that says so.
Plan plan_of_press(const Scene& scene, const ContactGeometry& geometry, const Plan& plan,
                   const PressRequest& request);

}  // namespace asperity
