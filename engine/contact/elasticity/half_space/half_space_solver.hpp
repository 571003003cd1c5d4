// SPDX-License-Identifier: GPL-3.0-or-later
// Two elastic half-spaces with rough faces pressed together, with or without a limit on the pressure:
// half_space_solve.hpp for the bodies of a contact as they lie. It turns a request into a problem and the
// answer into a State; pressures, lengths and the shares of the two bodies meet here and nowhere else.
#pragma once

#include <memory>

#include "engine/contact/plan.hpp"
#include "engine/contact/solver.hpp"

namespace asperity {

class HalfSpaceSolver final : public Solver {
 public:
  HalfSpaceSolver(const Plan& plan, const HalfSpaceOperator& half_space,
                  std::shared_ptr<const ContactGeometry> geometry);

  using Solver::press;
  // Besides what check(PressRequest) refuses: what solve_at_pressure and solve_at_approach refuse, and
  // `indentation` or `flatten` of heights that are all equal.
  State press(const PressRequest& request, Monitor& monitor) const override;
  const ContactGeometry& geometry() const override;
  const StateCost& preparation() const override;

 private:
  class UnderLoad;  // the Solution
  struct Ready;     // what all presses share

  Plan plan_;
  std::shared_ptr<const Ready> ready_;
};

}  // namespace asperity
