// SPDX-License-Identifier: GPL-3.0-or-later
// Two elastic half-spaces with rough faces, with or without yield: converts a request to a problem and the
// answer to a State.
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
  // Throws also the errors of solve_at_pressure and solve_at_approach, and on `indentation` or `flatten` of
  // equal heights.
  State press(const PressRequest& request, Monitor& monitor) const override;
  // Uses `guess` for pressure and load without missing heights.
  State press_from(const Solution& guess, const PressRequest& request, Monitor& monitor) const override;

 private:
  class UnderLoad;  // the Solution
  struct Ready;

  // `start` may be null.
  State pressed(const PressRequest& request, const HalfSpaceAnswer* start, Monitor& monitor) const;

  std::shared_ptr<const Ready> ready_;
};

// Solves, or loads the answer from the run's result store. The key contains every number of the problem,
// fields as digests. `by`: prescribed quantity ("pressure", "approach", "flatten"); `value` in SI; `start`
// may be null.
Costed<HalfSpaceAnswer> recall_or_solve(const HalfSpaceProblem& problem, std::string_view by, double value,
                                        const HalfSpaceAnswer* start, Monitor& monitor,
                                        const std::function<HalfSpaceAnswer()>& solve);

// `start` as in adhere_at_pressure; null: separated bodies.
Costed<AdhesiveAnswer> recall_or_adhere(const AdhesiveProblem& problem, std::string_view by, double value,
                                        const AdhesiveAnswer* start, Monitor& monitor,
                                        const std::function<AdhesiveAnswer()>& solve);

}  // namespace asperity
