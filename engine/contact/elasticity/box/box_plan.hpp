// SPDX-License-Identifier: GPL-3.0-or-later
// What box elements add to a plan: their stiffness with where it comes from, how two bodies share the
// shortening, and the sorted heights. The only effect-specific code between a scene and its solver.
#pragma once

#include "engine/contact/plan.hpp"

namespace asperity {

// Fills operator, term, buffers, solver name and expected time.
//
// stiffness: as given, or E*/(peak-to-valley of the combined heights as placed); then both bodies need
// `young` and `poisson` (or are rigid), and the combined heights must not all be equal.
// lower_share: a rigid body takes no shortening; two elastic bodies share it as their compliances
// (1−ν²)/E; where the materials do not say, a flat takes none and two rough bodies take half each.
// Throws Error{bad_state} naming effect and body, or Error{bad_value} naming `stiffness`.
void plan_box(const BoxOptions& options, const ContactGeometry& geometry, Plan& plan);

// The same without elastic shortening.
void plan_rigid(const ContactGeometry& geometry, Plan& plan);

// What yielding adds once the plan says whether anything does; nothing otherwise. Throws Error{bad_state}
// for rigid bodies that cannot yield: nothing would carry a load.
void plan_yield_of_boxes(const ContactGeometry& geometry, Plan& plan);

}  // namespace asperity
