// SPDX-License-Identifier: GPL-3.0-or-later
// Box elements under a plane: P_i = k δ_i with δ_i = max(0, d − (h_max − h_i)), one box to a node and
// no shear between them (the source paper: Hanaor, Gan & Einav 2013, there with k = E/A and ν = 0).
// The mean pressure is a piecewise linear function of the depth d, so pressure, load, approach,
// indentation and flattening are all prescribed in closed form; there is no iteration to tune. Past
// full contact the same line goes on. Boxes do not feel their neighbours: no volume is conserved.
#pragma once

#include <memory>

#include "engine/contact/elasticity/box/sorted_drops.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/solver.hpp"

namespace asperity {

class BoxSolver final : public Solver {
 public:
  // Sorts the combined heights: O(n) once. A press then costs O(log n).
  BoxSolver(const Plan& plan, const BoxOperator& box, std::shared_ptr<const ContactGeometry> geometry);

  using Solver::press;
  // Refused besides what check(PressRequest) refuses: a pressure above zero but below 1e-280 of the
  // modulus, one whose approach or peak leaves the range of a double, and `indentation` or `flatten`
  // of heights that are all equal.
  State press(const PressRequest& request, Monitor& monitor) const override;

 private:
  class UnderLoad;  // the Solution
  struct Ready;     // what all presses share
  struct Load {
    double load, pressure, approach;
  };
  Load resolve(const PressRequest& request) const;

  std::shared_ptr<const Ready> ready_;
};

// The check that ends a press in closed form. Works the certificate out; throws Error{not_converged} where
// rounding leaves it above the tolerance and the scene did not ask for the best there is.
void check_rounding(const State& state, const Accuracy& accuracy);

// Box elements that yield, and rigid ones, under a plane: each node carries what its element law says at its
// depth, and no node feels its neighbours. A body of rigid elements that yield at one pressure H is the
// bearing model of Abbott and Firestone (1933): the area that touches is the load over H, wherever the
// heights are. The depth follows from the load without iteration to tune (yielding_elements.hpp).
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
