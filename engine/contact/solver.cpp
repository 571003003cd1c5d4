// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/solver.hpp"

#include <utility>

namespace asperity {

std::shared_ptr<const Solver> make_solver(const Plan& plan, std::shared_ptr<const ContactGeometry> geometry) {
  return plan.model->solver(plan, std::move(geometry));
}

}  // namespace asperity
