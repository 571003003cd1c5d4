// SPDX-License-Identifier: GPL-3.0-or-later
// Contact conditions: certificate, 0 <= p <= H, gap >= 0, load, no negative energy or plastic volume, no
// NaN, valid algebraic bounds. Sums in long double.
#include <cmath>
#include <limits>

#include "engine/contact/effects/plasticity.hpp"
#include "tests/stability/properties/property.hpp"

namespace asperity::stability {

namespace {

std::string text(double value) { return exact(value); }

struct Scalar {
  const char* name;
  double (*value)(const State&);
  bool may_be_infinite = false;
  bool may_be_negative = false;
};
const Scalar scalars[] = {
    {"load", [](const State& s) { return s.load(); }},
    {"pressure", [](const State& s) { return s.pressure(); }},
    {"approach", [](const State& s) { return s.approach(); }},
    {"separation", [](const State& s) { return s.separation(); }, false, true},
    {"flatten", [](const State& s) { return s.flatten(); }},
    {"area", [](const State& s) { return s.area(); }},
    {"area_fraction", [](const State& s) { return s.area_fraction(); }},
    {"corrected_area_fraction", [](const State& s) { return s.corrected_area_fraction(); }},
    {"peak_pressure", [](const State& s) { return s.peak_pressure(); }},
    {"mean_gap", [](const State& s) { return s.mean_gap(); }},
    {"stiffness", [](const State& s) { return s.stiffness(); }, true},
    {"secant_stiffness", [](const State& s) { return s.secant_stiffness(); }, true},
    {"energy", [](const State& s) { return s.energy(); }},
    {"residual", [](const State& s) { return s.residual(); }},
    {"penetration", [](const State& s) { return s.certificate().penetration; }},
    {"tension", [](const State& s) { return s.certificate().tension; }},
    {"complementarity", [](const State& s) { return s.certificate().complementarity; }},
    {"load error", [](const State& s) { return s.certificate().load; }},
    {"cap error", [](const State& s) { return s.certificate().cap; }},
};

std::optional<Broken> scalar_is_wrong(const Scalar& scalar, const State& state) {
  const double value = scalar.value(state);
  const std::string lines = "print(st." + std::string(scalar.name) + ")\n";
  if (std::isnan(value) || (std::isinf(value) && !scalar.may_be_infinite))
    return Broken{std::string(scalar.name) + " is a number", text(value), lines};
  if (value < 0 && !scalar.may_be_negative)
    return Broken{std::string(scalar.name) + " is not negative", text(value), lines};
  return {};
}

std::optional<Broken> field_is_wrong(const Trial& trial, const State& state) {
  for (const std::string& name : State::field_names()) {
    if (name == "plastic" && !trial.scene.effects.find<PlasticityOptions>()) continue;
    const std::shared_ptr<const Field> field = state.field(name);
    for (std::size_t k = 0; k < field->size(); ++k) {
      const double value = (*field)[k];
      const std::string where = text(value) + " at node " + std::to_string(k);
      if (!std::isfinite(value)) return Broken{"field " + name + " is of numbers", where};
      if (value < 0 && name != "displacement") return Broken{"field " + name + " is not negative", where};
      if (name == "pressure" && value > trial.cap())
        return Broken{"no pressure passes the hardness", where + " over " + text(trial.cap())};
    }
  }
  // Throws for NaN.
  state.deformed("lower");
  state.deformed("upper");
  return {};
}

std::optional<Broken> sums_are_wrong(const Trial& trial, const State& state) {
  const Field& p = *state.field("pressure");
  const Field& gap = *state.field("gap");
  const Field& contact = *state.field("contact");
  long double sum = 0;
  double peak = 0;
  std::int64_t touching = 0;
  for (std::size_t k = 0; k < p.size(); ++k) {
    sum += p[k];
    peak = std::max(peak, p[k]);
    touching += p[k] > 0 ? 1 : 0;
    if ((p[k] > 0) != (contact[k] == 1)) return Broken{"contact is where there is pressure", text(p[k])};
    if (p[k] > 0 && gap[k] > 0) return Broken{"no gap under pressure", text(gap[k])};
  }
  const double mean = static_cast<double>(sum / static_cast<long double>(p.size()));
  if (!(std::abs(mean - trial.pressure) <= trial.scene.accuracy.tolerance * trial.pressure))
    return Broken{"the pressures carry the load", text(mean) + " of " + text(trial.pressure)};
  if (state.pressure() != trial.pressure)
    return Broken{"the state has the pressure asked for", text(state.pressure())};
  if (touching != state.contacts() || touching < 1)
    return Broken{"contacts are counted",
                  std::to_string(touching) + " of " + std::to_string(state.contacts())};
  if (std::abs(peak - state.peak_pressure()) > 1e-15 * peak)
    return Broken{"the peak is that of the field", text(peak) + " and " + text(state.peak_pressure())};
  double spots = 0;
  for (const double area : state.spot_areas()) spots += area;
  if (std::abs(spots - state.area()) > 1e-12 * state.area())
    return Broken{"spots add up to the area", text(spots) + " of " + text(state.area())};
  return {};
}

std::optional<Broken> plasticity_is_wrong(const State& state) {
  if (!(state.plastic_volume() >= 0) || std::isinf(state.plastic_volume()))
    return Broken{"plastic volume is not negative", text(state.plastic_volume())};
  if (!(state.plastic_fraction() >= 0 && state.plastic_fraction() <= 1))
    return Broken{"plastic fraction is a share", text(state.plastic_fraction())};
  const Field& w = *state.field("plastic");
  long double sum = 0;
  for (const double value : w.values()) sum += value;
  const double volume = static_cast<double>(sum) * state.geometry().grid().cell_area();
  if (std::abs(volume - state.plastic_volume()) > 1e-12 * volume)
    return Broken{"plastic volume is that of the field",
                  text(volume) + " and " + text(state.plastic_volume())};
  return {};
}

// A solve at tolerance 1e-13 is exact within its own bounds.
std::optional<Broken> bounds_are_wrong(const Trial& trial, const State& state) {
  Trial tight = trial;
  tight.scene.accuracy.tolerance = 1e-13;
  tight.scene.accuracy.on_failure = Accuracy::OnFailure::best;
  const State exact_state = pressed(tight);
  const AlgebraicError &of = state.algebraic_error(), &beside = exact_state.algebraic_error();
  struct {
    const char* name;
    double found, right, bound, own;
  } const all[] = {
      {"approach", state.approach(), exact_state.approach(), of.approach, beside.approach},
      {"energy", state.energy(), exact_state.energy(), of.energy, beside.energy},
      {"mean_gap", state.mean_gap(), exact_state.mean_gap(), of.mean_gap, beside.mean_gap},
      {"peak_pressure", state.peak_pressure(), exact_state.peak_pressure(), of.peak_pressure,
       beside.peak_pressure},
      {"contacts", static_cast<double>(state.contacts()), static_cast<double>(exact_state.contacts()),
       of.contacts, beside.contacts},
      {"plastic_volume", of.plastic_volume ? state.plastic_volume() : 0,
       of.plastic_volume ? exact_state.plastic_volume() : 0, of.plastic_volume.value_or(0),
       beside.plastic_volume.value_or(0)},
  };
  for (const auto& q : all) {
    const double digits = 2 * std::numeric_limits<double>::epsilon() * std::abs(q.found);
    if (!(std::abs(q.found - q.right) <= q.bound + q.own + digits))
      return Broken{"the algebraic error is a bound",
                    std::string(q.name) + " " + text(q.found) + " within " + text(q.bound) + ", and it is " +
                        text(q.right) + " within " + text(q.own),
                    "print(st.error.algebraic." + std::string(q.name) + ")\n"};
  }
  return {};
}

Verdict check(const Trial& trial, std::uint64_t) {
  const State state = pressed(trial);
  if (!state.converged() || !(state.residual() <= trial.scene.accuracy.tolerance))
    return Broken{"the certificate is met", text(state.residual()) + " by " + std::string(state.solver())};
  for (const Scalar& scalar : scalars)
    if (auto broken = scalar_is_wrong(scalar, state)) return broken;
  for (const double share : {state.flatten(), state.area_fraction()})
    if (!(share <= 1)) return Broken{"shares are at most 1", text(share)};
  if (auto broken = field_is_wrong(trial, state)) return broken;
  if (auto broken = sums_are_wrong(trial, state)) return broken;
  if (trial.scene.effects.find<PlasticityOptions>())
    if (auto broken = plasticity_is_wrong(state)) return broken;
  return bounds_are_wrong(trial, state);
}

}  // namespace

const Family conditions{"conditions", {}, check, 2000};

}  // namespace asperity::stability
