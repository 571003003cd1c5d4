// SPDX-License-Identifier: GPL-3.0-or-later
// Box elements under a plane: P_i = k δ_i with δ_i = max(0, d − (h_max − h_i)), one box per node, no shear
// between boxes (Hanaor, Gan & Einav 2013, there with k = E/A and ν = 0). The mean pressure is piecewise
// linear in the depth d: every prescribed quantity has a closed form, also past full contact. No volume is
// conserved.
#pragma once

#include <memory>

#include "engine/contact/elasticity/box/sorted_drops.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/solver.hpp"

namespace asperity {

class BoxSolver final : public Solver {
 public:
  // O(n) once (a sort); a press costs O(log n).
  BoxSolver(const Plan& plan, const BoxOperator& box, std::shared_ptr<const ContactGeometry> geometry);

  using Solver::press;
  // Besides check(PressRequest), refuses pressures above zero but below 1e-280 of the modulus, overflow of
  // approach or peak, and `indentation` or `flatten` of equal heights.
  State press(const PressRequest& request, Monitor& monitor) const override;

 private:
  class UnderLoad;  // the Solution
  struct Ready;
  struct Load {
    double load, pressure, approach;
  };
  Load resolve(const PressRequest& request) const;

  std::shared_ptr<const Ready> ready_;
};

// Computes the certificate of a closed form. Throws Error{not_converged} if rounding leaves it above the
// tolerance and the scene does not accept the best result.
void check_rounding(const State& state, const Accuracy& accuracy);

// Yielding box elements and rigid elements under a plane: each node carries the pressure of its element law
// at its depth (yielding_elements.hpp). Rigid elements with a single yield pressure H are the bearing model
// of Abbott and Firestone (1933): contact area = load / H.
class YieldingBoxSolver final : public Solver {
 public:
  // `plan` has a yield of finite hardness. O(n) once (a sort); a press O(log n), on hardened bodies O(n log
  // n).
  YieldingBoxSolver(const Plan& plan, const BoxOperator& box,
                    std::shared_ptr<const ContactGeometry> geometry);

  using Solver::press;
  // Besides check(PressRequest), refuses mean pressures at or above the hardness without hardening
  // (Error{infeasible}), or above zero but below 1e-280 of the hardness, overflow of depth or energy, and
  // `indentation` or `flatten` of equal heights.
  State press(const PressRequest& request, Monitor& monitor) const override;

 private:
  class UnderLoad;  // the Solution
  struct Ready;

  std::shared_ptr<const Ready> ready_;
};

}  // namespace asperity
