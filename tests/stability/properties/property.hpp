// SPDX-License-Identifier: GPL-3.0-or-later
// A check returns the first broken property of a scene; a thrown Error is a failure.
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
  std::string property;  // unchanged while a scene is reduced
  std::string how;       // with numbers
  std::string lines{};   // Lua after `c` and `st` of the script
};
using Verdict = std::optional<Broken>;  // none: all hold

struct Family {
  const char* name;
  Wanted wanted;
  // `salt` seeds a check's own draws, equal for a scene and its reductions.
  Verdict (*check)(const Trial& trial, std::uint64_t salt);
  int scenes;  // per run
  // Property of a whole run; may print statistics.
  Verdict (*after)() = nullptr;
};

// False while a scene is reduced.
extern bool counts_scenes;
extern std::uint64_t scene_in_turn;

extern const Family conditions, monotony, rescaling, symmetry, events, events_of_elements, threads, controls,
    explain;

// Throws RefusedByName if rounding prevents the tolerance, or for hardening on long cells.
inline State pressed_by(const Scene& scene, double pressure) {
  return SpecimenPair(scene).press({PressBy::pressure, pressure, {}});
}
inline State pressed(const Scene& scene, double pressure);
inline State pressed(const Trial& trial) { return pressed(trial.scene, trial.pressure); }

struct RefusedByName {};

inline double rms_height(const State& state) {
  const std::span<const double> h = state.geometry().combined().values();
  const double middle = mean(h);
  double sum = 0;
  for (const double z : h) sum += (z - middle) * (z - middle);
  return std::sqrt(sum / static_cast<double>(h.size()));
}

// Whether a solve ended at rounding level. Gaps are differences of displacements, heights and plastic
// displacements (pressure differences over the hardening); the certificate weights gaps by H/p̄ for a
// distant hardness.
inline bool doubles_hold_no_more(const Trial& trial, const State& state) {
  constexpr double ends_within = 100;  // times rounding; measured 63
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

// Hardening on long cells has a limit of transforms.
inline bool refuses_hardening(const Error& error) {
  return error.sentence().find("`hardening` on cells") != std::string::npos;
}

inline State pressed(const Scene& scene, double pressure) {
  try {
    return pressed_by(scene, pressure);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::not_converged) throw;
    if (refuses_hardening(error)) throw RefusedByName{};
    Trial best{scene, pressure, {}};
    best.scene.accuracy.on_failure = Accuracy::OnFailure::best;
    if (doubles_hold_no_more(best, pressed_by(best.scene, pressure))) throw RefusedByName{};
    throw;
  }
}

// Exchanges columns: to the other body's frame, and back. Empty under a flat.
inline Field turned_over(const Field& heights) {
  Field result(heights.nx(), heights.ny());
  for (int j = 0; j < heights.ny(); ++j)
    for (int i = 0; i < heights.nx(); ++i) result(i, j) = heights(heights.nx() - 1 - i, j);
  return result;
}

}  // namespace asperity::stability
