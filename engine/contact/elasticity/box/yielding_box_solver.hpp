// SPDX-License-Identifier: GPL-3.0-or-later
// Box elements that yield, and rigid ones, under a plane: each node carries what its element law says at its
// depth, and no node feels its neighbours. A body of rigid elements that yield at one pressure H is the
// bearing model of Abbott and Firestone (1933): the area that touches is the load over H, wherever the
// heights are. The depth follows from the load without iteration to tune (yielding_elements.hpp).
#pragma once

#include <memory>

#include "engine/contact/plan.hpp"
#include "engine/contact/solver.hpp"

namespace asperity {

class YieldingBoxSolver final : public Solver {
 public:
  // `plan` has a yield of finite hardness. Sorts the combined heights: O(n) once. A press then costs
  // O(log n), and O(n log n) on bodies that have hardened.
  YieldingBoxSolver(const Plan& plan, const BoxOperator& box,
                    std::shared_ptr<const ContactGeometry> geometry);

  using Solver::press;
  // Refused besides what check(PressRequest) refuses: a mean pressure at or above the hardness where nothing
  // hardens (Error{infeasible}); a pressure above zero but below 1e-280 of the hardness, or one whose depth
  // or energy leaves the range of a double; `indentation` or `flatten` of heights that are all equal.
  State press(const PressRequest& request, Monitor& monitor) const override;

 private:
  class UnderLoad;  // the Solution
  struct Ready;     // what all presses share

  std::shared_ptr<const Ready> ready_;
};

}  // namespace asperity
