// SPDX-License-Identifier: GPL-3.0-or-later
// Area and approach grow with load, and elastic energy without yielding (nodes at their hardness return
// energy). Near saturation a solve may return less, within its tolerance.
#include <cmath>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "tests/stability/properties/property.hpp"

namespace asperity::stability {

namespace {

// In tolerances: of the energy (measured 0.02), and of the rms height in the approach (measured 4.5, near
// the hardness, where one node decides).
constexpr double energy_slack = 0.2, approach_slack = 10;
constexpr double rounding = 1e-15;

Verdict check(const Trial& trial, std::uint64_t salt) {
  const double tolerance = trial.scene.accuracy.tolerance;
  const double low = trial.pressure;
  const double growth = std::pow(10.0, Stream(salt, "load").uniform(0, -3, 1));
  double high = low * (1 + growth);
  if (high >= trial.cap()) high = low + 0.5 * (trial.cap() - low);
  if (!(high > low)) return {};
  const State less = pressed(trial.scene, low), more = pressed(trial.scene, high);
  const std::string lines = "local more = c:press{ pressure=" + exact(high) +
                            " }\nprint(more.contacts - st.contacts, more.approach - st.approach, "
                            "more.energy - st.energy)\n";
  const auto numbers = [&](double a, double b) {
    return exact(a) + " at " + exact(low) + " Pa, " + exact(b) + " at " + exact(high) + " Pa";
  };
  if (more.contacts() < less.contacts())
    return Broken{"area grows with the load",
                  numbers(static_cast<double>(less.contacts()), static_cast<double>(more.contacts())), lines};
  if (more.approach() < less.approach() * (1 - rounding) - approach_slack * tolerance * rms_height(less))
    return Broken{"approach grows with the load", numbers(less.approach(), more.approach()), lines};
  if (!trial.scene.effects.find<PlasticityOptions>() &&
      more.energy() < (1 - energy_slack * tolerance) * less.energy())
    return Broken{"energy grows with the load", numbers(less.energy(), more.energy()), lines};
  return {};
}

}  // namespace

const Family monotony{"monotony", {}, check, 1500};

}  // namespace asperity::stability
