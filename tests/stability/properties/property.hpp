// SPDX-License-Identifier: GPL-3.0-or-later
// A family of properties: what every contact must do, checked on one random scene at a time. A check says
// which property broke first, and how; an Error thrown out of it counts as broken too.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/state.hpp"
#include "engine/core/error.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "tests/stability/properties/scene.hpp"

namespace asperity::stability {

struct Broken {
  std::string property;  // shrinking keeps to it
  std::string how;       // with its numbers
  std::string lines{};   // Lua that shows it, after `c` and `st` of the script
};
using Verdict = std::optional<Broken>;  // none: all hold

struct Family {
  const char* name;
  Wanted wanted;
  // `salt` is the source of what a check draws for itself: the same for a scene and its smaller ones.
  Verdict (*check)(const Trial& trial, std::uint64_t salt);
  int scenes;  // a run
  // What must hold of all of a run's scenes together; may print what it found.
  Verdict (*after)() = nullptr;
};

// Whether what `after` is told of counts: not while a scene is made smaller.
extern bool counts_scenes;
// The scene that is checked, for what is printed of it.
extern std::uint64_t scene_in_turn;

extern const Family conditions, monotony, rescaling, symmetry, events, events_of_elements, threads, controls,
    explain;

// The contact of a trial, fresh, under its pressure. Throws BeyondDoubles where that misses its tolerance
// because doubles hold no more.
inline State pressed_by(const Scene& scene, double pressure) {
  return SpecimenPair(scene).press({PressBy::pressure, pressure, {}});
}
inline State pressed(const Scene& scene, double pressure);
inline State pressed(const Trial& trial) { return pressed(trial.scene, trial.pressure); }

// Of a scene of which a family says nothing.
struct BeyondDoubles {};

inline double rms_height(const State& state) {
  const std::span<const double> h = state.geometry().combined().values();
  const double middle = mean(h);
  double sum = 0;
  for (const double z : h) sum += (z - middle) * (z - middle);
  return std::sqrt(sum / static_cast<double>(h.size()));
}

// Whether a solve ended where rounding hides the rest: gaps are differences of displacements, heights and
// what yielded, which is a difference of pressures over the hardening, and the certificate weighs them by H/p̄
// under a hardness far away.
inline bool doubles_hold_no_more(const Trial& trial, const State& state) {
  constexpr double ends_within = 100;  // of it; measured 63
  const auto greatest = [](std::span<const double> values) {
    const Range found = range(values);
    return std::max(std::abs(found.min), std::abs(found.max));
  };
  double lengths =
      greatest(state.field("displacement")->values()) + greatest(trial.scene.lower.heights().values());
  if (const auto* rough = std::get_if<Surface>(&trial.scene.upper))
    lengths += greatest(rough->heights().values());
  if (trial.hardens()) lengths += trial.hardness() / trial.scene.effects.find<PlasticityOptions>()->hardening;
  if (trial.scene.effects.find<PlasticityOptions>()) lengths += greatest(state.field("plastic")->values());
  const double weight = std::isfinite(trial.cap()) ? trial.cap() / trial.pressure : 1;
  return state.residual() < ends_within * 0x1p-53 * weight * lengths / rms_height(state);
}

inline State pressed(const Scene& scene, double pressure) {
  try {
    return pressed_by(scene, pressure);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::not_converged) throw;
    Trial best{scene, pressure, {}};
    best.scene.accuracy.on_failure = Accuracy::OnFailure::best;
    if (doubles_hold_no_more(best, pressed_by(best.scene, pressure))) throw BeyondDoubles{};
    throw;
  }
}

// The heights of the upper body as the lower one's nodes see them without turn or shift, and back: the same
// exchange of columns. Empty under a flat.
inline Field turned_over(const Field& heights) {
  Field result(heights.nx(), heights.ny());
  for (int j = 0; j < heights.ny(); ++j)
    for (int i = 0; i < heights.nx(); ++i) result(i, j) = heights(heights.nx() - 1 - i, j);
  return result;
}

}  // namespace asperity::stability
