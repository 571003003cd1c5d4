// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/friction/junction_law.hpp"

#include "engine/contact/effects/ageing.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

void require_finite(double value, std::string_view key) {
  require(value >= 0 && std::isfinite(value), key, value, "", "give a finite value from zero up");
}

void require_cap(const std::optional<double>& value, std::string_view key) {
  if (value) require(*value > 0, key, *value, "", "give a pressure above zero; leave it out for no cap");
}

constexpr double infinite = std::numeric_limits<double>::infinity();

// Least normal stress at the cap; the same test as for level junctions.
double stress_at_cap(const JunctionLaw& law) {
  if (!law.tau_max()) return infinite;
  const double room = *law.tau_max() - law.tau0();
  if (room <= 0) return 0;
  return law.alpha() > 0 ? room / law.alpha() : infinite;
}

struct Neighbours {
  int before, after, steps;
};
Neighbours neighbours(int k, int n, bool wraps) {
  if (wraps) return {k > 0 ? k - 1 : n - 1, k < n - 1 ? k + 1 : 0, 2};
  const int before = std::max(0, k - 1), after = std::min(n - 1, k + 1);
  return {before, after, std::max(1, after - before)};
}

// With heights; overhanging bodies have a free boundary without wrap.
template <class There>
Neighbours inside(Neighbours all, int k, There there) {
  if (!there(all.before)) all.before = k;
  if (!there(all.after)) all.after = k;
  return {all.before, all.after, std::max(1, all.after - all.before)};
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
    refuse("`tau_max` and `yield_pressure` are both given",
           "give one: `yield_pressure` means tau_max = tau0 + alpha yield_pressure");
  std::optional<double> cap = options.tau_max;
  // With α = 0 no cap can bind; avoids 0·∞.
  if (options.yield_pressure && alpha_ > 0) cap = tau0_ + alpha_ * *options.yield_pressure;
  if (cap && std::isfinite(*cap)) tau_max_ = cap;
}

double JunctionLaw::strength(double pressure) const {
  const double strength = tau0_ + alpha_ * pressure;
  return tau_max_ ? std::min(strength, *tau_max_) : strength;
}

FrictionResult JunctionLaw::on(const State& state, std::optional<double> rest) const {
  check_rest(rest, state.effects());
  const auto* ageing = state.effects().find<AgeingOptions>();
  if (ageing == nullptr) return fresh(state);
  const double factor = strengthening(*ageing, rest);
  JunctionLaw rested = *this;
  rested.tau0_ *= factor;
  FrictionResult result = rested.fresh(state);
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

InclinedJunction inclined_junction(const JunctionLaw& law, double pressure, double along, double across) {
  const double rise = 1 + along * along;
  const double widening = std::sqrt(1 + across * across / rise);
  const double wedge = along * widening;  // normal stress per shear
  InclinedJunction result;
  const auto with = [&](double shear) { return along * pressure + rise * widening * shear; };
  if (along == 0 && across == 0) {
    // Level bodies give exactly the result without interlocking.
    result.force = law.strength(pressure);
    result.capped = pressure >= stress_at_cap(law);
    return result;
  }
  if (law.tau_max() && pressure + wedge * *law.tau_max() >= stress_at_cap(law)) {
    result.capped = true;
    result.force = with(*law.tau_max());
    return result;
  }
  const double room = 1 - wedge * law.alpha();
  if (!(room > 0)) {
    result.locks = true;
    result.force = infinite;
    return result;
  }
  double shear = (law.tau0() + law.alpha() * pressure) / room;
  if (wedge < 0) shear = std::min(shear, pressure / -wedge);
  result.force = with(shear);
  return result;
}

Slopes junction_slopes(const State& state) {
  const Grid& grid = state.geometry().grid();
  const bool wraps = state.geometry().boundary() == Boundary::periodic;
  const Surface lower = state.deformed("lower");
  const std::shared_ptr<const Field> gap = state.field("gap");
  Field middle(grid.nx, grid.ny);
  for (std::size_t k = 0; k < middle.size(); ++k) middle[k] = lower.heights()[k] + 0.5 * (*gap)[k];
  Slopes slopes{Field(grid.nx, grid.ny), Field(grid.nx, grid.ny)};
  const bool overhangs = state.geometry().overhangs();
  for (int j = 0; j < grid.ny; ++j) {
    const Neighbours rows = neighbours(j, grid.ny, wraps);
    for (int i = 0; i < grid.nx; ++i) {
      const Neighbours columns = neighbours(i, grid.nx, wraps);
      Neighbours across = columns, along = rows;
      if (overhangs) {  // a missing counterpart is a rim
        if (std::isnan(middle(i, j))) continue;
        across = inside(columns, i, [&](int k) { return !std::isnan(middle(k, j)); });
        along = inside(rows, j, [&](int k) { return !std::isnan(middle(i, k)); });
      }
      slopes.x(i, j) = (middle(across.after, j) - middle(across.before, j)) / (across.steps * grid.hx());
      slopes.y(i, j) = (middle(i, along.after) - middle(i, along.before)) / (along.steps * grid.hy());
    }
  }
  return slopes;
}

InterlockedJunctions interlock(const JunctionLaw& law, const State& state,
                               const InterlockingOptions& options) {
  InterlockedJunctions result;
  if (state.contacts() == 0) return result;
  const Slopes slopes = junction_slopes(state);
  const std::shared_ptr<const Field> pressure = state.field("pressure");
  const double c = elementary::cos(options.direction), s = elementary::sin(options.direction);
  Field extra(pressure->nx(), pressure->ny());
  std::int64_t capped = 0, locked = 0;
  for (std::size_t k = 0; k < extra.size(); ++k) {
    const double p = (*pressure)[k];
    if (!(p > 0)) continue;
    const double along = c * slopes.x[k] + s * slopes.y[k], across = c * slopes.y[k] - s * slopes.x[k];
    const InclinedJunction junction = inclined_junction(law, p, along, across);
    capped += junction.capped ? 1 : 0;
    locked += junction.locks ? 1 : 0;
    extra[k] = junction.force - law.strength(p);
  }
  if (locked > 0)
    refuse_state(std::to_string(locked) + " of " + std::to_string(state.contacts()) +
                     " junctions are so steep that they lock: their slope times `alpha` is one or more",
                 "give the law a `tau_max`, the strength at which they shear off");
  result.extra_force = block_sum(extra.values()) * state.geometry().grid().cell_area();
  result.capped_fraction = static_cast<double>(capped) / static_cast<double>(state.contacts());
  return result;
}

}  // namespace asperity
