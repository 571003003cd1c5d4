// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/solver.hpp"

#include <utility>

#include "engine/contact/elasticity/box/box_solver.hpp"
#include "engine/contact/elasticity/box/yielding_box_solver.hpp"
#include "engine/contact/elasticity/half_space/adhesion/adhesive_solver.hpp"
#include "engine/contact/elasticity/half_space/half_space_solver.hpp"

namespace asperity {

std::shared_ptr<const Solver> make_solver(const Plan& plan, std::shared_ptr<const ContactGeometry> geometry) {
  if (const auto* box = std::get_if<BoxOperator>(&plan.elasticity)) {
    if (plan.yield && plan.yield->limits())
      return std::make_shared<const YieldingBoxSolver>(plan, *box, std::move(geometry));
    return std::make_shared<const BoxSolver>(plan, *box, std::move(geometry));
  }
  if (plan.attracts())
    return std::make_shared<const AdhesiveSolver>(plan, std::get<HalfSpaceOperator>(plan.elasticity),
                                                  std::move(geometry));
  return std::make_shared<const HalfSpaceSolver>(plan, std::get<HalfSpaceOperator>(plan.elasticity),
                                                 std::move(geometry));
}

}  // namespace asperity
