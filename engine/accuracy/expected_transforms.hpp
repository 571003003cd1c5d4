// SPDX-License-Identifier: GPL-3.0-or-later
// How many transforms a press of half-spaces will take, before it is made: the very press is tried on fewer
// cells, a hundred a side or more, and its count P carried to the cells given,
//   T = P 2^(l (a + b s)),   l = ½ log2(nodes / nodes tried),   s² = ⟨(h_k − h_k+1)²⟩ / (2 ⟨(h − ⟨h⟩)²⟩),
// l the times each side was halved and s <= 1 the share of the heights that lies in waves of a few cells,
// along the rougher side: 1 of white noise, next to nothing of smooth ground. a and b are of the quantity
// that is prescribed. A tile of no more nodes than are tried takes what the trial took, to the last
// transform. What is tried and thrown away changes nothing: no counter of costs, no law met, no contact. How
// often T holds is at the head of tests/stability/properties/explain.cpp; constants, and the command that
// fits them again, are at the head of the source.
#pragma once

#include <string>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/press_request.hpp"
#include "engine/contact/scene.hpp"

namespace asperity {

struct ExpectedTransforms {
  double transforms = 0;  // T, equivalents of the finest grid
  Grid tried_on;
  double tried = 0;      // P, equivalents of `tried_on`
  bool ended = true;     // the trial came to an answer; T is more than is told here otherwise
  std::string refused;   // why it was refused on so few cells; T is then that of a press by pressure
  double halvings = 0;   // l
  double roughness = 0;  // s
  double work = 0;       // what trying it took, equivalents of the finest grid
};

// The cells on which a press of a contact on `grid` is tried: of about the same shape, at most a 32nd of the
// nodes or 96², whichever is more; `grid` itself where it has no more.
Grid trial_grid(const Grid& grid);

// Of a half-space pressed as `request` says, for the bodies as they lie in `geometry`, with what `plan`,
// which is theirs, remembers. O(nodes) and the press on the trial's cells. Throws what check(request) throws.
ExpectedTransforms expected_transforms(const Scene& scene, const ContactGeometry& geometry, const Plan& plan,
                                       const PressRequest& request);

// `plan` with the transforms and the time of this press and the sentence that says so.
Plan plan_of_press(const Scene& scene, const ContactGeometry& geometry, const Plan& plan,
                   const PressRequest& request);

}  // namespace asperity
