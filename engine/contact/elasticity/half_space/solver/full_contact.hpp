// SPDX-License-Identifier: GPL-3.0-or-later
// Where a press by approach or by flattening ends. All of a periodic half-space touches, elastically, at an
// approach of max h − mean h, for nothing but the mean of the heights is left to move; the least load that
// brings it there follows from one exact filter, p = (E*|q|/2) h. A layer goes on being compressed, by K(0)
// p̄. Ground that does not harden comes to an end where every node is at its cap. Also says so to the user.
#pragma once

#include <optional>
#include <string>

#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"

namespace asperity {

// Whether something faces the ground at node k.
bool faces(const HalfSpaceProblem& problem, std::size_t k);

// max h − mean h, m, what K(0) of a layer adds left out.
double approach_of_full_contact(const HalfSpaceProblem& problem);

// The least mean pressure, Pa, under which all of a periodic tile touches and nothing yields. None where
// there is no such pressure. One application.
std::optional<double> pressure_of_full_contact(const HalfSpaceProblem& problem);

// The contact under that pressure. `missed`: of what was prescribed, relative to it.
HalfSpaceAnswer solve_at_full_contact(const HalfSpaceProblem& problem, double mean_pressure, double missed,
                                      Monitor& monitor);

// Throws Error{infeasible} where no load gives the approach: past full contact of a periodic half-space, or,
// where it hardens, once the pressure would hide all heights.
void check_approach_within_full_contact(const HalfSpaceProblem& problem, double approach);

// Where all nodes that something faces are at the cap: the greatest approach that is theirs, m, the last of
// them just touching.
std::optional<double> most_at_the_cap(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer);

// The answer if it converged or the best will do. Throws Error{infeasible} where all nodes are at the cap and
// {not_converged} otherwise; `what` was prescribed.
HalfSpaceAnswer met(const HalfSpaceProblem& problem, HalfSpaceAnswer answer, const std::string& what);

}  // namespace asperity
