// SPDX-License-Identifier: GPL-3.0-or-later
// Plasticity: the pressure is capped by the hardness of the softer body, 0 <= p <= H, and the plastic
// approach w that the cap leaves open is taken from both bodies, half each of like ones and nearly all from
// the softer of unlike ones (lower_plastic_share), by the hardness that each node has by then. With hardening
// a node carries H + K_h w instead. Volume is removed, not redistributed; a rigid body and a flat
// counter-body take no share.
#pragma once

#include <optional>

#include "engine/contact/plan.hpp"
#include "engine/contact/solution.hpp"
#include "engine/contact/yield_law.hpp"

namespace asperity {

// Fills plan.yield and its term. Throws Error{bad_state} naming effect and body where a hardness is
// missing, or where no body can yield.
void plan_plasticity(const PlasticityOptions& options, const ContactGeometry& geometry, Plan& plan);

// The bodies after an event, in their own frames.
struct YieldedBodies {
  Surface lower;
  UpperBody upper;
  HardnessMemory hardness;
  // Of what the upper body lost: mapped off the lattice over meant, before it was scaled to be equal.
  double mapped_volume = 1;
};

// Takes `change` from the bodies of `geometry`. Stored heights are never resampled: only the increment is
// mapped. O(n).
YieldedBodies yielded_bodies(const ContactGeometry& geometry, const PlannedYield& yield,
                             const PlasticChange& change);

// The hardness of each node of the lower body with the upper one on it, the lower of both, Pa; none where it
// is the same everywhere. Each of `lower` and `upper` seen from the lower body.
struct LocalHardness {
  std::shared_ptr<const Field> lower, upper;
};
LocalHardness local_hardness(const ContactGeometry& geometry, const PlannedYield& yield);

// What limits the pressure while the hardness is `factor` of the one stated.
YieldLaw yield_law(const PlannedYield& yield, const LocalHardness& local, double factor);

}  // namespace asperity
