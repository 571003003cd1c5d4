// SPDX-License-Identifier: GPL-3.0-or-later
// The bench: two specimens, how the upper one lies on the lower, and what the scene computes. The only
// thing of the laboratory that changes; copying it copies its whole present state, cheaply, for the
// heights are shared. What a press flattens for good stays on the specimens, each in its own frame, and
// is all that events leave: stored heights are never resampled. Each call either completes or leaves the
// pair as it was. What does not depend on the load (for box elements the sorted heights) is worked out
// at the first press after a change of the bodies or of how they lie, and kept, so a sweep up or down is
// repeated presses. Not for use from two threads at once.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/accuracy/chosen_accuracy.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/scene.hpp"
#include "engine/contact/solver.hpp"
#include "engine/contact/state.hpp"
#include "engine/friction/partial_slip.hpp"
#include "engine/specimen/protocol.hpp"

namespace asperity {

// The new placement of the upper body by the stream "placement" of `seed`. It is exact on the lattice, so
// nothing is resampled: turned by 0, 90, 180 or 270 deg (0 or 180 when cells or sizes differ in x and y),
// then shifted by whole cells along x and y; on a free boundary not shifted at all, because a body beyond the
// rim would touch nothing. Away from the axis of a disc, a turn brings a statistically new surface; on one
// tile, a shift represents this turn.
LatticeIsometry draw_placement(const Grid& grid, Boundary boundary, std::uint64_t seed);

class SpecimenPair {
 public:
  // One event in the history of the pair, with the measured values of a press.
  struct Done {
    struct Measured {
      double load, pressure, approach, area_fraction, peak_pressure;
    };
    Protocol::Step step;
    std::optional<double> time{};  // s, as a protocol recorded it
    std::optional<Measured> measured{};
  };

  // The upper body is turned over and placed without turn or shift. Throws the errors of check(Scene) and
  // make_plan; O(n) for two rough bodies, no solve.
  explicit SpecimenPair(const Scene& scene);

  // The state under this load. The bodies recover elastically at release; the plastic deformation stays.
  // Under a load that they have carried as they lie, or less, nothing yields again (planned_yield.hpp). Warns
  // once where bodies that do not continue across the rim lie on a periodic half-space, where a dwell is
  // named and creep is not, and where a turn off the lattice maps the yielded volume badly (it is scaled to
  // be kept). If the scene requests an accuracy, the first press under load chooses cells and tolerance for
  // it and puts the bodies on these cells, where they stay (accuracy_choice.hpp); presses after it are held
  // to the error there.
  State press(const PressRequest& request, Monitor& monitor = Monitor::silent());
  // Frees the memory of every state pressed here that is still held; values read before stay
  // (State::close).
  void close();
  // Whether close() was called; a copy of a closed pair is open.
  bool closed() const { return closed_; }
  // A pair of the same bodies, lying and loaded alike, that is pressed and closed by itself.
  SpecimenPair copy() const;

  // Takes the load off.
  void release();
  bool under_load() const { return under_load_; }
  // The contact under its present load, pulled sideways; nothing of the pair changes. Throws the errors of
  // shear(), and Error{bad_state} without load.
  PartialSlip shear(const ShearRequest& request, Monitor& monitor = Monitor::silent());
  // The state of the last press while its load is on; kept for partial slip alone (has_tangential), null
  // without it.
  const State* pressed() const { return under_load_ && pressed_ ? &*pressed_ : nullptr; }

  // Lifts the upper specimen and puts it down as draw_placement(seed) says, whatever came before.
  void place(std::uint64_t seed);
  // Turns the upper specimen about the centre of the nodes, counter-clockwise seen from above the lower
  // one. Turns add up; within 1e-9 rad of a whole multiple of 90 deg the nodes lie on nodes. On a periodic
  // boundary only such turns fit: throws Error{bad_value} naming `place` otherwise, and for a quarter turn
  // of a tile that is not square.
  void rotate(double angle);
  // Shifts the upper specimen by (x, y) m, whole cells (to 1e-9 of a cell), on a periodic boundary only.
  void shift(double x, double y);

  // Throws the predictable errors of a step: an impossible turn or shift, and a mean pressure above the
  // capacity of the nodes together. `lying` is the placement before the step, and then after it.
  void check_ahead(const Protocol::Step& step, Pose& lying) const;

  // The events since the pair was made, in order; a copy begins with its original's events.
  const std::vector<Done>& history() const { return history_; }
  // Gives a time to every entry of that list from number `first` on.
  void date(std::size_t first, std::optional<double> time);

  // Each body as it is now, in its own frame. A flat counter-body is a surface of zeros.
  const Surface& lower() const { return scene_.lower; }
  Surface upper() const;
  bool upper_is_flat() const { return geometry_->upper_is_flat(); }

  const Scene& scene() const { return scene_; }
  const Pose& pose() const { return geometry_->pose(); }
  // The part of the pose that is on the lattice.
  const LatticeIsometry& placement() const { return pose().lattice(); }
  // Traces of events on the bodies, apart from their shapes.
  const BodyMemory& memory() const { return geometry_->memory(); }
  // Work and cost of a press in advance; plan().text() prints them. Before an accuracy is chosen, of
  // the cells given.
  const Plan& plan() const { return plan_; }
  // The same with the transforms and the time of this very press, which is tried on fewer cells
  // (expected_transforms.hpp); nothing of the pair changes. Throws the same errors as press().
  Plan plan_of(const PressRequest& request) const;
  // The pair made ready to be pressed as it lies now; worked out once per placement.
  std::shared_ptr<const Solver> solver();

 private:
  void lay(const Pose& pose);
  Pose turned(const Pose& from, double angle) const;
  Pose shifted(const Pose& from, double x, double y) const;
  void carry(const State& state, const PressRequest& request);
  void unload();
  void warn(const PressRequest& request, Monitor& monitor);
  State choose_and_press(const PressRequest& request, Monitor& monitor);
  // Permanent traces of `state` on the bodies, by the effects of the scene, with their cost.
  StateCost leave_on_bodies(const State& state, Monitor& monitor);
  void warn_of_an_overhang(Monitor& monitor);
  void warn_of_a_step_at_the_rim(Monitor& monitor);

  Scene scene_;  // with the bodies as they are now
  std::shared_ptr<const ContactGeometry> geometry_;
  Plan plan_;
  std::shared_ptr<const Solver> solver_;          // none until the first press after a placement
  std::shared_ptr<const ChosenAccuracy> chosen_;  // none until the first press under load, or none asked for
  bool under_load_ = false;
  bool closed_ = false;
  std::optional<State> pressed_;
  std::vector<State::Watch> states_;  // those pressed here
  std::vector<Done> history_;
  bool warned_of_overhang_ = false;
  bool warned_of_rim_ = false;
  bool warned_of_mapping_ = false;
  bool warned_of_dwell_ = false;
  bool warned_of_plan_ = false;
};

}  // namespace asperity
