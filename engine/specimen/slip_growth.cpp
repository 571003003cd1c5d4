// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/specimen/slip_growth.hpp"

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/error.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

SlipShare share_at(const Solver& contact, const State& state, double friction, double angle,
                   Monitor& monitor) {
  SlipShare share{angle, 1, 1, {}};
  if (!(friction > 0)) return share;
  // The slip angle is accurate to rounding only.
  constexpr double rounding = 1e-9;
  const double ratio = elementary::tan(angle) / friction;
  share.ratio = ratio < 1 - rounding ? ratio : 1;
  const PartialSlip slip = shear(contact, state, {{}, share.ratio, friction}, monitor);
  share.slip_fraction = slip.slip_fraction();
  share.displacement = slip.displacement();
  return share;
}

}  // namespace

std::vector<SlipShare> slip_growth(const SpecimenPair& pair, const JunctionLaw& law,
                                   const TiltTrialOptions& options, int steps, Monitor& monitor) {
  require_tangential(pair.scene().effects);
  require(steps >= 1 && steps <= 10000, "steps", steps, "", "give a whole number from 1 to 10000");
  TiltTrialOptions once = options;
  once.repeats = 1;
  once.scatter = 0;
  const TiltResult raised = raise(pair, law, once, monitor);
  SpecimenPair bench = pair;
  if (!bench.upper_is_flat()) bench.place(tilt_placement(options, 0));
  const std::shared_ptr<const Solver> contact = bench.solver();

  const double weight =
      options.stage.mass * options.stage.gravity *
      (bench.lower().grid().area() / options.specimen_area.value_or(bench.lower().grid().area()));
  std::optional<State> probe;
  double friction = 0;
  if (!raised.probes.empty()) {
    probe = contact->press({PressBy::pressure, raised.probes.front().pressure, {}}, monitor);
    for (const TiltProbe& at : raised.probes) friction += at.mu / static_cast<double>(raised.probes.size());
    // A solved weight has its own friction.
    if (!raised.at_weight.empty() && raised.slipped) friction = elementary::tan(raised.angle);
  }

  std::vector<SlipShare> growth;
  Task task(monitor, "growth of slip", steps);
  for (int k = 1; k <= steps; ++k) {
    const double angle = raised.angle * k / steps;
    if (probe) {
      growth.push_back(share_at(*contact, *probe, friction, angle, monitor));
      growth.back().displacement.reset();
    } else {
      const State state = contact->press({PressBy::load, weight * elementary::cos(angle), {}}, monitor);
      growth.push_back(share_at(*contact, state, law.on(state, options.rest).mu.value_or(0), angle, monitor));
    }
    task.advance();
  }
  return growth;
}

}  // namespace asperity
