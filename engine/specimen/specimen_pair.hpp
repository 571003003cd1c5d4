// SPDX-License-Identifier: GPL-3.0-or-later
// The bench: two specimens, their pose, and the scene; the only mutable object of the laboratory. Copies are
// cheap, because heights are shared. Plastic deformation stays on each specimen in its own frame; heights are
// never resampled. Each call completes or leaves the pair unchanged. Preparations are cached until bodies or
// pose change. Not thread-safe.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/accuracy/chosen_accuracy.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/scene/scene.hpp"
#include "engine/contact/solver.hpp"
#include "engine/contact/state.hpp"
#include "engine/friction/partial_slip.hpp"
#include "engine/specimen/protocol.hpp"

namespace asperity {

// From the stream "placement" of `seed`, exact on the lattice: a turn by 0, 90, 180 or 270 deg (0 or 180 if
// cells or sizes differ in x and y), then shifts by whole cells, except on a free boundary, where the body
// would leave the rim. A shift represents the new surface that a turn brings away from the axis of a disc.
LatticeIsometry draw_placement(const Grid& grid, Boundary boundary, std::uint64_t seed);

class SpecimenPair {
 public:
  // With the measured values of a press.
  struct Done {
    struct Measured {
      double load, pressure, approach, area_fraction, peak_pressure;
    };
    Protocol::Step step;
    std::optional<double> time{};  // s, as recorded
    std::optional<Measured> measured{};
  };

  // The upper body is turned over. Throws as check(Scene) and make_plan do. O(n), no solve.
  explicit SpecimenPair(const Scene& scene);

  // The state under this load; plastic deformation stays after release. Nothing yields again under loads that
  // the bodies carried in this pose (planned_yield.hpp). Warns once of a step at the rim of a periodic
  // half-space, a dwell without creep, and a turn off the lattice that maps the yielded volume badly (it is
  // scaled). With a requested accuracy, the first press under load chooses cells and tolerance and moves the
  // bodies there for good (accuracy_choice.hpp); later presses are checked against the request.
  State press(const PressRequest& request, Monitor& monitor = Monitor::silent());
  // Frees all states pressed here; values read before stay valid (State::close).
  void close();
  // A copy of a closed pair is open.
  bool closed() const { return closed_; }
  SpecimenPair copy() const;

  void release();
  bool under_load() const { return under_load_; }
  // Partial slip under the present load; changes nothing. Throws as shear() does, and Error{bad_state}
  // without load.
  PartialSlip shear(const ShearRequest& request, Monitor& monitor = Monitor::silent());
  // Null without load or tangential effect.
  const State* pressed() const { return under_load_ && pressed_ ? &*pressed_ : nullptr; }

  // By draw_placement(seed), from any pose.
  void place(std::uint64_t seed);
  // About the centre of the nodes, counter-clockwise seen from above the lower specimen; turns add up. Within
  // 1e-9 rad of multiples of 90 deg, nodes meet nodes; a periodic boundary requires this. Throws
  // Error{bad_value} otherwise, and for a quarter turn of a tile that is not square.
  void rotate(double angle);
  // m, whole cells (to 1e-9 of a cell), periodic boundary only.
  void shift(double x, double y);

  // Throws predictable errors: an impossible turn or shift, a mean pressure above the capacity of the nodes.
  // Updates the pose `lying`.
  void check_ahead(const Protocol::Step& step, Pose& lying) const;

  // A copy begins with its original's events.
  const std::vector<Done>& history() const { return history_; }
  // Dates the events from `first` on.
  void date(std::size_t first, std::optional<double> time);

  // In the body's frame. A flat has zero heights.
  const Surface& lower() const { return scene_.lower; }
  Surface upper() const;
  bool upper_is_flat() const { return geometry_->upper_is_flat(); }

  const Scene& scene() const { return scene_; }
  const Pose& pose() const { return geometry_->pose(); }
  const LatticeIsometry& placement() const { return pose().lattice(); }
  const BodyMemory& memory() const { return geometry_->memory(); }
  // Work and cost of a press, for the given cells before an accuracy is chosen.
  const Plan& plan() const { return plan_; }
  // The same for this very press, tried on fewer cells (expected_transforms.hpp). Throws as press() does.
  Plan plan_of(const PressRequest& request) const;
  // Prepared once per placement.
  std::shared_ptr<const Solver> solver();

 private:
  void lay(const Pose& pose);
  Pose turned(const Pose& from, double angle) const;
  Pose shifted(const Pose& from, double x, double y) const;
  void carry(const State& state, const PressRequest& request);
  void unload();
  void warn(const PressRequest& request, Monitor& monitor);
  State choose_and_press(const PressRequest& request, Monitor& monitor);
  // By the effects of the scene, with their cost.
  StateCost leave_on_bodies(const State& state, Monitor& monitor);
  void warn_of_an_overhang(Monitor& monitor);
  void warn_of_a_step_at_the_rim(Monitor& monitor);

  Scene scene_;
  std::shared_ptr<const ContactGeometry> geometry_;
  Plan plan_;
  std::shared_ptr<const Solver> solver_;          // none before the first press
  std::shared_ptr<const ChosenAccuracy> chosen_;  // none before the first loaded press, or without request
  bool under_load_ = false;
  bool closed_ = false;
  std::optional<State> pressed_;
  std::vector<State::Watch> states_;  // pressed here
  std::vector<Done> history_;
  bool warned_of_overhang_ = false;
  bool warned_of_rim_ = false;
  bool warned_of_mapping_ = false;
  bool warned_of_dwell_ = false;
  bool warned_of_plan_ = false;
};

}  // namespace asperity
