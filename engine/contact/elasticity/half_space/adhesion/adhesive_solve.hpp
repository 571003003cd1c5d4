// SPDX-License-Identifier: GPL-3.0-or-later
// Half-spaces that attract each other: find contact pressures p >= 0 and gaps g >= 0 with
//   g = K(p − σ(g)) + d − δ,   p g = 0,
// d the depth of a node below the highest, δ the approach and σ(g) the sum of the gap terms. This is a
// stationary point of ½ u·K⁻¹u + Σ φ(g), φ concave. Each step replaces φ by its tangent, which lies above it:
// an ordinary contact with the attraction held fixed, whose minimum lowers the energy again
// (majorise–minimise). As K >= 0 and σ falls with g the steps are monotone too: begun without attraction
// they close in from outside and end on the branch of bodies brought together; begun with the attraction of
// a deeper contact they end on the branch of bodies pulled apart. So each branch is followed through its
// jump, and what is reached is stable from the side it was reached from.
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
  // Of its fields: pressure p, gap g, mean_pressure the load carried from outside, mean p − mean σ.
  HalfSpaceAnswer contact;
  Field attraction;            // σ(g), Pa
  double mean_attraction = 0;  // Pa
  std::vector<double> shares;  // of the mean attraction, one a term; alike where nothing pulls
  double stationarity = 0;     // max |σ(g) − σ held| / max σ
  int steps = 0;               // tangents taken
  // What the first contact took, the attraction held fixed: what there would be to do without its tangents.
  Cost first_contact;
};

// At this approach, of either sign: from apart, or from the attraction and pressures of `start`.
// Takes some 80 applications of K, 1800 on the hardest of 60 contacts, and some 20 000 at most. Throws
// Error{not_converged} unless best_effort, Error{infeasible} where numbers overflow, and when asked to stop.
AdhesiveAnswer adhere_at_approach(const AdhesiveProblem& problem, double approach,
                                  const AdhesiveAnswer* start, Monitor& monitor);

// Under this mean pressure from outside, below zero for a pull. Throws Error{infeasible} where the bodies
// separate.
AdhesiveAnswer adhere_at_pressure(const AdhesiveProblem& problem, double mean_pressure,
                                  const AdhesiveAnswer* start, Monitor& monitor);

}  // namespace asperity
