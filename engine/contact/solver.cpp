// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/solver.hpp"

#include <utility>

#include "engine/contact/elasticity/box_solver.hpp"

namespace asperity {

std::shared_ptr<const Solver> make_solver(const Plan& plan, std::shared_ptr<const ContactGeometry> geometry) {
  return std::visit(
      [&](const BoxOperator& box) -> std::shared_ptr<const Solver> {
        return std::make_shared<const BoxSolver>(plan, box, std::move(geometry));
      },
      plan.elasticity);
}

}  // namespace asperity
