// SPDX-License-Identifier: GPL-3.0-or-later
// Two attracting elastic half-spaces (adhesive_solve.hpp). Loads and approaches may be negative. Bodies
// start separated or from the turning points of `preload`; a pull starts from zero load. The last preload is
// cached; results do not depend on it. The ledger charges the first contact of each turn to elasticity and
// divides the rest among the attractions by force.
#pragma once

#include <memory>

#include "engine/contact/elasticity/half_space/adhesion/adhesive_solve.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/solver.hpp"

namespace asperity {

class AdhesiveSolver final : public Solver {
 public:
  AdhesiveSolver(const Plan& plan, const HalfSpaceOperator& half_space,
                 std::shared_ptr<const ContactGeometry> geometry);

  using Solver::press;
  // Throws also Error{infeasible} if a pull separates the bodies or an approach exceeds periodic full
  // contact.
  State press(const PressRequest& request, Monitor& monitor) const override;

 private:
  class UnderLoad;  // the Solution
  struct Ready;
  StateCost parted(const Cost& whole, const Cost& contacts, const AdhesiveAnswer& answer) const;

  std::shared_ptr<const Ready> ready_;
};

}  // namespace asperity
