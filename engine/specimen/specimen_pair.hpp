// SPDX-License-Identifier: GPL-3.0-or-later
// The bench: two specimens, their pose, and the scene; the only mutable object of the laboratory. Copies are
// cheap, because heights are shared. Plastic deformation stays on each specimen in its own frame; heights are
// never resampled. Each call completes or leaves the pair unchanged. Preparations are cached until bodies or
// pose change. Not thread-safe.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/accuracy/chosen_accuracy.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/scene/scene.hpp"
#include "engine/contact/solver.hpp"
#include "engine/contact/state.hpp"
#include "engine/friction/partial_slip.hpp"
#include "engine/specimen/protocol.hpp"

namespace asperity {

// From stream "placement" of `seed`, exact on the lattice: a turn by 0, 90, 180 or 270 deg (0 or 180 if cells
// or sizes differ in x and y), then shifts by whole cells, unless the boundary is free. A shift represents
// the new surface off the axis of a turned disc.
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

  // Turns the upper body over. Throws as check(Scene) and make_plan. O(n), no solve.
  explicit SpecimenPair(const Scene& scene);

  // Plastic deformation stays after release; loads carried in this pose cause no further yield
  // (planned_yield.hpp). Warns once of a step at the rim of a periodic half-space, dwells without creep, and
  // a turn off the lattice with badly mapped yielded volume (scaled). With a requested accuracy, the first
  // press under load chooses cells and tolerance and moves the bodies there for good (accuracy_choice.hpp);
  // later presses are checked.
  State press(const PressRequest& request, Monitor& monitor = Monitor::silent());
  // Frees all states pressed here; values read before stay valid (State::close).
  void close();
  // A copy of a closed pair is open.
  bool closed() const { return closed_; }
  SpecimenPair copy() const;

  void release();
  bool under_load() const { return under_load_; }
  // Under the present load; changes nothing. Throws as shear(), and Error{bad_state} without load.
  PartialSlip shear(const ShearRequest& request, Monitor& monitor = Monitor::silent());
  // Null without load or tangential effect.
  const State* pressed() const { return under_load_ && pressed_ ? &*pressed_ : nullptr; }

  // By draw_placement(seed), from any pose.
  void place(std::uint64_t seed);
  // About the centre of the nodes, counter-clockwise seen from above the lower specimen; turns add up. Within
  // 1e-9 rad of multiples of 90 deg, nodes meet nodes; periodic boundaries require this. Throws
  // Error{bad_value} otherwise, and for a quarter turn of an oblong tile.
  void rotate(double angle);
  // m, whole cells (to 1e-9), periodic only.
  void shift(double x, double y);
  // Returns the state of a press.
  std::optional<State> perform(const Protocol::Step& step, Monitor& monitor);

  // Throws predictable errors: impossible turns or shifts, mean pressures above the capacity of the nodes.
  // Updates the pose `lying`.
  void check_ahead(const Protocol::Step& step, Pose& lying) const;

  // A copy starts with its original's events.
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
  // Work and cost; for the given cells before an accuracy is chosen.
  const Plan& plan() const { return plan_; }
  // For this press, from one trial (accuracy/companion_grids.hpp). Throws as press().
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
  State finished(State state, const PressRequest& request, Monitor& monitor);
  // By the scene's effects, with their cost.
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

// One event per call. A failed event leaves the pair unchanged and is tried again.
class ProtocolRun {
 public:
  // Throws the first predictable error (SpecimenPair::check_ahead).
  ProtocolRun(Protocol protocol, std::shared_ptr<SpecimenPair> pair);

  const Protocol& protocol() const { return protocol_; }
  SpecimenPair& pair() const { return *pair_; }
  bool finished() const { return next_ >= protocol_.count(); }
  // From 0.
  std::size_t next() const { return next_; }

  // Returns the state of a press. Progress counts presses only. Throws as the pair, and Error{interrupted |
  // time_limit | ...} on a stop before an event. Precondition: not finished().
  std::optional<State> step(Monitor& monitor = Monitor::silent());

 private:
  std::string title(std::size_t k) const;
  // Errors get the title of event k.
  template <class Work>
  void with_title(std::size_t k, const Work& work) const;

  Protocol protocol_;
  std::shared_ptr<SpecimenPair> pair_;
  std::size_t next_ = 0;
  std::size_t presses_ = 0, pressed_ = 0;
  std::chrono::steady_clock::time_point begun_;
};

}  // namespace asperity
