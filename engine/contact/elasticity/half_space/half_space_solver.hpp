// SPDX-License-Identifier: GPL-3.0-or-later
// Two elastic half-spaces with rough faces pressed together, with or without a limit on the pressure:
// half_space_solve.hpp for the bodies of a contact as they lie. It turns a request into a problem and the
// answer into a State; pressures, lengths and the shares of the two bodies meet here and nowhere else.
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "engine/contact/elasticity/half_space/adhesion/adhesive_solve.hpp"
#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/solver.hpp"
#include "engine/core/files/result_store.hpp"

namespace asperity {

class HalfSpaceSolver final : public Solver {
 public:
  HalfSpaceSolver(const Plan& plan, const HalfSpaceOperator& half_space,
                  std::shared_ptr<const ContactGeometry> geometry);

  using Solver::press;
  // Besides what check(PressRequest) refuses: what solve_at_pressure and solve_at_approach refuse, and
  // `indentation` or `flatten` of heights that are all equal.
  State press(const PressRequest& request, Monitor& monitor) const override;
  // By pressure or load of bodies that cover each other; otherwise as press().
  State press_from(const Solution& guess, const PressRequest& request, Monitor& monitor) const override;

 private:
  class UnderLoad;  // the Solution
  struct Ready;     // what all presses share

  // Under a load from `start`, if not null.
  State pressed(const PressRequest& request, const HalfSpaceAnswer* start, Monitor& monitor) const;

  std::shared_ptr<const Ready> ready_;
};

// The solves of half_space_solve.hpp, displacement_control.hpp and adhesive_solve.hpp, taken up from the
// store of the run where the same problem was solved before. A key is made of every number that a problem
// holds, heights and hardness fields by their digests. `by` names the prescribed quantity ("pressure",
// "approach", "flatten") and `value` is in its SI unit; `start` is what the solve begins from, or null.
Costed<HalfSpaceAnswer> recall_or_solve(const HalfSpaceProblem& problem, std::string_view by, double value,
                                        const HalfSpaceAnswer* start, Monitor& monitor,
                                        const std::function<HalfSpaceAnswer()>& solve);

// `start` as in adhere_at_pressure; null from apart.
Costed<AdhesiveAnswer> recall_or_adhere(const AdhesiveProblem& problem, std::string_view by, double value,
                                        const AdhesiveAnswer* start, Monitor& monitor,
                                        const std::function<AdhesiveAnswer()>& solve);

}  // namespace asperity
