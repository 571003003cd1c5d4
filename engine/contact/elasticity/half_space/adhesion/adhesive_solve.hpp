// SPDX-License-Identifier: GPL-3.0-or-later
// Attracting half-spaces: find contact pressures p >= 0 and gaps g >= 0 with
//   g = K(p − σ(g)) + d − δ,   p g = 0,
// d: depth of a node below the highest; δ: approach; σ(g): sum of the gap terms. A solution is a stationary
// point of ½ u·K⁻¹u + Σ φ(g), φ concave. Each step replaces φ by its tangent (majorise–minimise): an
// ordinary contact with fixed attraction, which lowers the energy. K >= 0 and σ falls with g, so the steps
// are monotone: from no attraction they converge to the approaching branch, from the attraction of a deeper
// contact to the retracting branch. Both branches are followed through their jump instabilities.
#pragma once

#include <vector>

#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"
#include "engine/contact/gap_term.hpp"
#include "engine/core/cost.hpp"

namespace asperity {

struct AdhesiveProblem {
  HalfSpaceProblem contact;  // no yield
  std::vector<GapTerm> attraction;
};

struct AdhesiveAnswer {
  // mean_pressure: external load, mean p − mean σ.
  HalfSpaceAnswer contact;
  Field attraction;            // σ(g), Pa
  double mean_attraction = 0;  // Pa
  std::vector<double> shares;  // of the mean attraction, per term
  double stationarity = 0;     // max |σ(g) − σ fixed| / max σ
  int steps = 0;               // tangents
  // With fixed attraction.
  Cost first_contact;
};

// At an approach of either sign, from separated bodies or `start`. Typically 80 applications of K, at most
// 20000. Throws Error{not_converged} unless best_effort, {infeasible} on overflow or beyond periodic full
// contact.
AdhesiveAnswer adhere_at_approach(const AdhesiveProblem& problem, double approach,
                                  const AdhesiveAnswer* start, Monitor& monitor);

// External mean pressure, negative for a pull. Throws Error{infeasible} if the bodies separate.
AdhesiveAnswer adhere_at_pressure(const AdhesiveProblem& problem, double mean_pressure,
                                  const AdhesiveAnswer* start, Monitor& monitor);

}  // namespace asperity
