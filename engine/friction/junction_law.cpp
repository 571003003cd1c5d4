// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/friction/junction_law.hpp"

#include <algorithm>
#include <cmath>

#include "engine/contact/effects/ageing.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"
#include "engine/friction/interlocking.hpp"

namespace asperity {

namespace {

void require_finite(double value, std::string_view key) {
  require(value >= 0 && std::isfinite(value), key, value, "", "give a finite value from zero up");
}

void require_cap(const std::optional<double>& value, std::string_view key) {
  if (value) require(*value > 0, key, *value, "", "give a pressure above zero; leave it out for no cap");
}

}  // namespace

void check_rest(std::optional<double> rest, const Effects& effects) {
  if (!rest) return;
  require(*rest >= 0 && std::isfinite(*rest), "rest", *rest, "s", "give a time from zero up");
  if (!effects.has<AgeingOptions>())
    refuse_without("`rest`", "`ageing`",
                   "name ageing={ rate=, onset= } in the effects of the contact, or leave `rest` out");
}

double strengthening(const Effects& effects, std::optional<double> rest) {
  const auto* ageing = effects.find<AgeingOptions>();
  return ageing == nullptr ? 1.0 : strengthening(*ageing, rest);
}

JunctionLaw::JunctionLaw(const FrictionOptions& options) : tau0_(options.tau0), alpha_(options.alpha) {
  require_finite(options.tau0, "tau0");
  require_finite(options.alpha, "alpha");
  require_cap(options.tau_max, "tau_max");
  require_cap(options.yield_pressure, "yield_pressure");
  if (options.tau_max && options.yield_pressure)
    throw Error(ErrorCode::bad_value, "`tau_max` and `yield_pressure` are both given",
                "give one: `yield_pressure` stands for tau_max = tau0 + alpha yield_pressure");
  std::optional<double> cap = options.tau_max;
  // With α = 0 no cap can bind; avoids 0·∞.
  if (options.yield_pressure && alpha_ > 0) cap = tau0_ + alpha_ * *options.yield_pressure;
  if (cap && std::isfinite(*cap)) tau_max_ = cap;
}

double JunctionLaw::strength(double pressure) const {
  const double strength = tau0_ + alpha_ * pressure;
  return tau_max_ ? std::min(strength, *tau_max_) : strength;
}

JunctionLaw JunctionLaw::rested(double strengthening) const {
  JunctionLaw result = *this;
  result.tau0_ *= strengthening;
  return result;
}

FrictionResult JunctionLaw::on(const State& state, std::optional<double> rest) const {
  check_rest(rest, state.effects());
  const auto* ageing = state.effects().find<AgeingOptions>();
  if (ageing == nullptr) return fresh(state);
  const double factor = strengthening(*ageing, rest);
  FrictionResult result = rested(factor).fresh(state);
  result.strengthening = factor;
  return result;
}

FrictionResult JunctionLaw::fresh(const State& state) const {
  FrictionResult result;
  const double area = state.area(), load = state.load();
  const double cell = state.geometry().grid().cell_area();
  result.adhesive_force = strength(0) * area;
  result.load_force = alpha_ * (load + state.attraction());
  if (tau_max_ && state.contacts() > 0) {
    const double room = *tau_max_ - tau0_;
    if (room <= 0) {
      result.load_force = 0;
      result.capped_fraction = 1;
    } else if (alpha_ > 0 && alpha_ * state.peak_pressure() >= room) {
      const PressureSplit nodes = state.split(room / alpha_);
      result.load_force = (static_cast<double>(nodes.above) * room + alpha_ * nodes.sum_below) * cell;
      result.capped_fraction = static_cast<double>(nodes.above) / static_cast<double>(state.contacts());
    }
  }
  result.force = result.adhesive_force + result.load_force;
  if (const auto* interlocking = state.effects().find<InterlockingOptions>()) {
    const InterlockedJunctions junctions = interlock(*this, state, *interlocking);
    result.interlocking_force = junctions.extra_force;
    result.capped_fraction = junctions.capped_fraction;
    result.force += junctions.extra_force;
  }
  if (load > 0) result.mu = result.force / load;
  return result;
}

std::string JunctionLaw::text() const {
  const std::string line = format_quantity(tau0_, dimension::pressure) + " + " + format_short(alpha_) + " P";
  if (!tau_max_) return "tau = " + line;
  return "tau = min(" + line + ", " + format_quantity(*tau_max_, dimension::pressure) + ")";
}

}  // namespace asperity
