// SPDX-License-Identifier: GPL-3.0-or-later
// The solves of half_space_solve.hpp, displacement_control.hpp and adhesive_solve.hpp, taken
// up from the store of the run where the same problem was solved before. A key is made of every number that a
// problem holds, heights and hardness fields by their digests.
#pragma once

#include <functional>
#include <string_view>

#include "engine/contact/elasticity/half_space/adhesion/adhesive_solve.hpp"
#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"
#include "engine/core/files/result_store.hpp"

namespace asperity {

// `by` names the prescribed quantity ("pressure", "approach", "flatten") and `value` is in its SI unit.
Costed<HalfSpaceAnswer> recall_or_solve(const HalfSpaceProblem& problem, std::string_view by, double value,
                                        Monitor& monitor, const std::function<HalfSpaceAnswer()>& solve);

// `start` as in adhere_at_pressure; null from apart.
Costed<AdhesiveAnswer> recall_or_adhere(const AdhesiveProblem& problem, std::string_view by, double value,
                                        const AdhesiveAnswer* start, Monitor& monitor,
                                        const std::function<AdhesiveAnswer()>& solve);

}  // namespace asperity
