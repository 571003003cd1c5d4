// SPDX-License-Identifier: GPL-3.0-or-later
// A contact ready to be pressed: all work independent of the load is done. Immutable: threads may press at
// once. A press depends only on request and guess.
#pragma once

#include <memory>
#include <utility>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/scene/press_request.hpp"
#include "engine/contact/solution.hpp"
#include "engine/contact/state.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

class Solver {
 public:
  virtual ~Solver() = default;

  // Throws Error{bad_value} for a negative, non-finite or too small request, Error{infeasible} without
  // solution, Error{not_converged} if the certificate misses the tolerance and the scene does not accept the
  // best result.
  virtual State press(const PressRequest& request, Monitor& monitor) const = 0;
  State press(const PressRequest& request) const { return press(request, Monitor::silent()); }
  // Starts from `guess`, a similar press on any cells of the tile, if this saves transforms. The last digits
  // depend on the guess.
  virtual State press_from(const Solution& guess, const PressRequest& request, Monitor& monitor) const {
    static_cast<void>(guess);
    return press(request, monitor);
  }
  const ContactGeometry& geometry() const { return *geometry_; }
  // Once for all presses.
  const StateCost& preparation() const { return preparation_; }

 protected:
  Solver(const Plan& plan, std::shared_ptr<const ContactGeometry> geometry)
      : plan_(plan), geometry_(std::move(geometry)) {}

  Plan plan_;
  std::shared_ptr<const ContactGeometry> geometry_;
  StateCost preparation_;  // set by the constructor of a solver
};

inline std::shared_ptr<const Solver> make_solver(const Plan& plan,
                                                 std::shared_ptr<const ContactGeometry> geometry) {
  return plan.model->solver(plan, std::move(geometry));
}

}  // namespace asperity
