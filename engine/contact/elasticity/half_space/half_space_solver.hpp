// SPDX-License-Identifier: GPL-3.0-or-later
// Two elastic half-spaces with rough faces, with or without yield or attraction: converts a request to a
// problem and the answer to a State.
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "engine/contact/elasticity/half_space/adhesion/adhesive_solve.hpp"
#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"
#include "engine/contact/solver.hpp"
#include "engine/core/files/result_store.hpp"

namespace asperity {

// Refuses as solve_at_pressure and solve_at_approach, and `indentation` or `flatten` of equal heights.
// press_from uses the guess for pressure and load without missing heights.
std::shared_ptr<const Solver> make_half_space_solver(const Plan& plan,
                                                     std::shared_ptr<const ContactGeometry> geometry);

// Two attracting half-spaces (adhesive_solve.hpp). Loads and approaches may be negative. Starts from
// separated bodies or the turning points of `preload`, a pull from zero load. Caching the last preload does
// not affect results. The ledger charges the first contact of each turn to elasticity and divides the rest
// among the attractions by force. Error{infeasible} if a pull separates the bodies or beyond periodic full
// contact.
std::shared_ptr<const Solver> make_adhesive_solver(const Plan& plan,
                                                   std::shared_ptr<const ContactGeometry> geometry);

// Solves, or loads the answer from the run's result store. Key: every number of the problem, digests of
// fields. `by`: "pressure", "approach", "flatten"; `value` in SI; `start` may be null.
Costed<HalfSpaceAnswer> recall_or_solve(const HalfSpaceProblem& problem, std::string_view by, double value,
                                        const HalfSpaceAnswer* start, Monitor& monitor,
                                        const std::function<HalfSpaceAnswer()>& solve);

// `start` as in adhere_at_pressure; null: separated bodies.
Costed<AdhesiveAnswer> recall_or_adhere(const AdhesiveProblem& problem, std::string_view by, double value,
                                        const AdhesiveAnswer* start, Monitor& monitor,
                                        const std::function<AdhesiveAnswer()>& solve);

}  // namespace asperity
