// SPDX-License-Identifier: GPL-3.0-or-later
// Two elastic half-spaces whose faces attract each other: adhesive_solve.hpp for the bodies of a contact as
// they lie. Loads and approaches may be below zero. Bodies are brought together from apart, or, where the
// request says `preload`, taken there first, turn by turn. Under a pull they are pressed by no load
// first: a pull brings nothing together. The last turn is kept, so that requests after the same turns,
// as those of a sweep are, go there once; no bit depends on it. Of what a press costs, the first contact of
// each turn is elasticity's; the tangents are the attractions', parted by what each pulls in the end.
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
  // Besides what check(PressRequest) refuses: Error{infeasible} where a pull separates the bodies, and where
  // an approach is past full contact of a periodic tile.
  State press(const PressRequest& request, Monitor& monitor) const override;

 private:
  class UnderLoad;  // the Solution
  struct Ready;     // what all presses share
  StateCost parted(const Cost& whole, const Cost& contacts, const AdhesiveAnswer& answer) const;

  std::shared_ptr<const Ready> ready_;
};

}  // namespace asperity
