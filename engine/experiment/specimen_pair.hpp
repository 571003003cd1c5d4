// SPDX-License-Identifier: GPL-3.0-or-later
// The bench: two specimens, how the upper one lies on the lower, and what the scene computes. The only
// thing of the laboratory that changes; copying it copies its whole present state, cheaply, for the
// heights are shared. Each call either completes or leaves the pair as it was. What does not depend on
// the load (for box elements the sorted heights) is worked out at the first press after a placement
// and kept, so a sweep up or down is repeated presses. Not for use from two threads at once.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "engine/contact/plan.hpp"
#include "engine/contact/scene.hpp"
#include "engine/contact/solver.hpp"
#include "engine/contact/state.hpp"

namespace asperity {

class SpecimenPair {
 public:
  // Turned over and laid down without turn or shift. Throws what check(Scene) and make_plan throw; O(n)
  // for two rough bodies, no solve.
  explicit SpecimenPair(const Scene& scene);

  // The state under this load. The bodies come back elastically at release.
  State press(const PressRequest& request, Monitor& monitor = Monitor::silent());
  // Takes the load off.
  void release();
  bool under_load() const { return under_load_; }

  // Lifts the upper specimen and puts it down as draw_placement(seed) says, whatever came before.
  void place(std::uint64_t seed);
  // Turns the upper specimen about the centre of the nodes, counter-clockwise seen from above the lower
  // one. Whole multiples of 90 deg (to 1e-9 rad) only: throws Error{bad_value} naming `place` otherwise,
  // and for a quarter turn of a tile that is not square.
  void rotate(double angle);
  // Shifts the upper specimen by (x, y) m, whole cells (to 1e-9 of a cell), on a periodic boundary only.
  void shift(double x, double y);

  // Each body as it is now, in its own frame. A flat counter-body is a surface of zeros.
  const Surface& lower() const { return scene_.lower; }
  Surface upper() const;
  bool upper_is_flat() const { return geometry_->upper_is_flat(); }

  const Scene& scene() const { return scene_; }
  const LatticeIsometry& placement() const { return geometry_->placement(); }
  // What a press will compute, and at what cost; plan().text() prints it.
  const Plan& plan() const { return plan_; }
  // The pair made ready to be pressed as it lies now; worked out once per placement.
  std::shared_ptr<const Solver> solver();

 private:
  void lay(const LatticeIsometry& placement);

  Scene scene_;
  std::shared_ptr<const ContactGeometry> geometry_;
  Plan plan_;
  std::shared_ptr<const Solver> solver_;  // none until the first press after a placement
  bool under_load_ = false;
};

}  // namespace asperity
