// SPDX-License-Identifier: GPL-3.0-or-later
// A contact made ready to be pressed: the bodies as they lie, the plan carried out as far as it does
// not depend on the load. Which solver it is follows from the plan alone. Immutable, so many threads
// may press at once, and each press depends on nothing but its request and, where one is given, a guess.
#pragma once

#include <memory>
#include <utility>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/press_request.hpp"
#include "engine/contact/solution.hpp"
#include "engine/contact/state.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

class Solver {
 public:
  virtual ~Solver() = default;

  // The state under this load. Throws Error{bad_value} for a request that makes no sense (negative, not
  // finite, too small to mean anything), Error{infeasible} for one that has no solution, and
  // Error{not_converged} when the certificate misses the tolerance and the scene did not ask for the
  // best there is.
  virtual State press(const PressRequest& request, Monitor& monitor) const = 0;
  State press(const PressRequest& request) const { return press(request, Monitor::silent()); }
  // The same within the tolerance, begun from `guess`, a press like it on these or other cells of the tile,
  // where that saves transforms. The last digits depend on the guess.
  virtual State press_from(const Solution& guess, const PressRequest& request, Monitor& monitor) const {
    static_cast<void>(guess);
    return press(request, monitor);
  }
  const ContactGeometry& geometry() const { return *geometry_; }
  // What making it ready cost, once for all presses.
  const StateCost& preparation() const { return preparation_; }

 protected:
  Solver(const Plan& plan, std::shared_ptr<const ContactGeometry> geometry)
      : plan_(plan), geometry_(std::move(geometry)) {}

  Plan plan_;
  std::shared_ptr<const ContactGeometry> geometry_;
  StateCost preparation_;  // the constructor of a solver sets it
};

// Does what is done once for all loads (for box elements: the sort, O(n)).
inline std::shared_ptr<const Solver> make_solver(const Plan& plan,
                                                 std::shared_ptr<const ContactGeometry> geometry) {
  return plan.model->solver(plan, std::move(geometry));
}

}  // namespace asperity
