// SPDX-License-Identifier: GPL-3.0-or-later
// A contact ready to be pressed: all work independent of the load is done. Immutable: threads may press at
// once. A press depends only on request and guess.
#pragma once

#include <memory>
#include <utility>

#include "engine/contact/scene/press_request.hpp"
#include "engine/contact/solution.hpp"
#include "engine/contact/state.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

class Solver {
 public:
  virtual ~Solver() = default;

  // Throws Error{bad_value} for a negative, non-finite or too small request, {infeasible} without solution,
  // {not_converged} if the certificate misses the tolerance and the scene does not accept the best result.
  virtual State press(const PressRequest& request, Monitor& monitor) const = 0;
  State press(const PressRequest& request) const { return press(request, Monitor::silent()); }
  // Starts from `guess`, a similar press on any cells of the tile, if this saves transforms. Last digits
  // depend on it.
  virtual State press_from(const Solution& guess, const PressRequest& request, Monitor& monitor) const {
    static_cast<void>(guess);
    return press(request, monitor);
  }
  const ContactGeometry& geometry() const { return *contact_.geometry; }
  // Once for all presses.
  const StateCost& preparation() const { return preparation_; }

 protected:
  Solver(const Plan& plan, std::shared_ptr<const ContactGeometry> geometry)
      : contact_{std::make_shared<const Plan>(plan), std::move(geometry)} {}
  const Plan& plan() const { return *contact_.plan; }

  PlacedContact contact_;
  StateCost preparation_;  // set by a solver's constructor
};

inline std::shared_ptr<const Solver> make_solver(const Plan& plan,
                                                 std::shared_ptr<const ContactGeometry> geometry) {
  return plan.elasticity->solver(plan, std::move(geometry));
}

}  // namespace asperity
