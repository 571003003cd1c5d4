// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/experiment/tilt_trials.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "engine/core/elementary_functions.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/random.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

// With fewer nodes in contact, area and friction change with the grid.
constexpr std::int64_t enough_contacts = 50;

void check_trials(const TiltTrialOptions& options) {
  check(options.stage);
  if (options.specimen_area && !(*options.specimen_area > 0 && std::isfinite(*options.specimen_area)))
    throw Error(ErrorCode::bad_value, "`specimen_area` is " + format_short(*options.specimen_area) + " m^2",
                "give a finite area above zero");
  if (!(options.scatter >= 0 && options.scatter < 1))
    throw Error(ErrorCode::bad_value, "`scatter` is " + format_short(options.scatter),
                "it is a relative standard deviation: give a number from 0 to below 1");
  if (options.probe_pressures.empty() ||
      !std::all_of(options.probe_pressures.begin(), options.probe_pressures.end(),
                   [](double p) { return p > 0 && std::isfinite(p); }))
    throw Error(ErrorCode::bad_value, "`probe_pressure` holds a pressure that is not finite and above zero",
                "give one or more, such as { \"1 MPa\", \"3 MPa\" }");
  if (options.repeats < 1 || options.repeats > 100000)
    throw Error(ErrorCode::bad_value, "`repeats` is " + std::to_string(options.repeats),
                "give a whole number from 1 to 100000");
}

// A half-space contact at a pressure that the grid resolves.
TiltProbe probe(const Solver& contact, const JunctionLaw& law, double pressure,
                const TiltTrialOptions& options, Monitor& monitor) {
  const auto nodes = static_cast<std::int64_t>(contact.geometry().grid().nodes());
  for (;; pressure *= 2) {
    const State state = contact.press({PressBy::pressure, pressure, {}}, monitor);
    if (state.contacts() < std::min(enough_contacts, nodes)) continue;
    const FrictionResult friction = law.on(state, options.rest);
    const double corrected = state.corrected_area_fraction() / state.area_fraction();
    return {pressure,
            state.contacts(),
            state.plastic_change().has_value(),
            state.corrected_area_fraction() / state.pressure(),
            (friction.adhesive_force * corrected + friction.load_force +
             friction.interlocking_force.value_or(0)) /
                state.load(),
            state.attraction() / state.load()};
  }
}

std::vector<TiltProbe> probe_all(const Solver& contact, const JunctionLaw& law,
                                 const TiltTrialOptions& options, Monitor& monitor) {
  std::vector<TiltProbe> probes;
  for (const double pressure : options.probe_pressures)
    probes.push_back(probe(contact, law, pressure, options, monitor));
  return probes;
}

double mean_of(std::span<const TiltProbe> probes, double TiltProbe::*quantity) {
  double sum = 0;
  for (const TiltProbe& probe : probes) sum += probe.*quantity;
  return sum / static_cast<double>(probes.size());
}

void add_sentence(std::string& note, const std::string& sentence) {
  if (!note.empty()) note += "; ";
  note += sentence;
}

double tangent(double angle) {
  return angle >= 0.5 * std::numbers::pi ? std::numeric_limits<double>::infinity() : elementary::tan(angle);
}

double standard_deviation(const std::vector<double>& values) {
  if (std::all_of(values.begin(), values.end(), [&](double v) { return v == values.front(); })) return 0;
  const auto n = static_cast<double>(values.size());
  if (std::isinf(*std::max_element(values.begin(), values.end())))
    return std::numeric_limits<double>::infinity();
  double mean = 0, squares = 0;
  for (const double v : values) mean += v / n;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / (n - 1));
}

std::string note_on(const TiltResult& result, const TiltTrialOptions& options, bool flat) {
  std::string note;
  const auto slips =
      std::count_if(result.trials.begin(), result.trials.end(), [](const SlipAngle& t) { return t.slipped; });
  const std::string limit = format_short(options.stage.limit * 180 / std::numbers::pi) + " deg";
  if (slips == 0)
    note = "does not slip up to " + limit + ": mu is a lower bound";
  else if (!result.slipped)
    note = "does not slip up to " + limit + " in " +
           std::to_string(result.trials.size() - static_cast<std::size_t>(slips)) + " of " +
           std::to_string(result.trials.size()) + " trials: mu is a lower bound";
  if (flat && result.trials.size() > 1)
    add_sentence(note, options.scatter > 0
                           ? "the counter-body is flat: trials differ only by `scatter`"
                           : "the counter-body is flat and `scatter` is 0: all trials are the same");
  if (!result.probes.empty()) {
    const auto raised =
        std::max_element(result.probes.begin(), result.probes.end(),
                         [](const TiltProbe& a, const TiltProbe& b) { return a.pressure < b.pressure; });
    const double asked = *std::max_element(options.probe_pressures.begin(), options.probe_pressures.end());
    if (raised->pressure > asked)
      add_sentence(note, "the probe pressure was raised to " +
                             format_quantity(raised->pressure, dimension::pressure) + " until " +
                             std::to_string(raised->contacts) + " nodes touched");
    if (std::any_of(result.probes.begin(), result.probes.end(), [](const TiltProbe& p) { return p.yields; }))
      add_sentence(note,
                   "spots yield under the probe pressure, which bounds area per load by one over the "
                   "hardness; without `plasticity` the probe is elastic");
    if (const double pull = mean_of(result.probes, &TiltProbe::attraction); pull > 0)
      add_sentence(note,
                   "the bodies attract each other by " + format_short(pull, 3) +
                       " of the load at the probe pressures, which is taken to hold down to the weight; "
                       "bodies that stick without a load hold more");
    add_sentence(note,
                 "real area per load is taken from the probe pressures down to the weight; tau0 is an "
                 "effective, calibrated number, so only ratios of mu are predictions");
  }
  return note;
}

}  // namespace

std::uint64_t tilt_placement(const TiltTrialOptions& options, int trial) {
  return Stream(options.seed, "tilt placement").bits(static_cast<std::uint64_t>(trial));
}

TiltResult raise(const SpecimenPair& pair, const JunctionLaw& law, const TiltTrialOptions& options,
                 Monitor& monitor) {
  check_trials(options);
  check_rest(options.rest, pair.scene().sliding);
  SpecimenPair bench = pair;
  const bool flat = bench.upper_is_flat();
  const double tile_share =
      bench.lower().grid().area() / options.specimen_area.value_or(bench.lower().grid().area());
  const Stream scatter(options.seed, "tilt scatter");

  TiltResult result;
  Task task(monitor, "tilt stage", options.repeats);
  const bool half_space = std::holds_alternative<HalfSpaceOptions>(bench.scene().elasticity);
  std::vector<TiltProbe> probes;
  std::int64_t fewest = std::numeric_limits<std::int64_t>::max();
  for (int trial = 0; trial < options.repeats; ++trial) {
    const auto k = static_cast<std::uint64_t>(trial);
    if (!flat) bench.place(tilt_placement(options, trial));
    const std::shared_ptr<const Solver> solver = bench.solver();
    // A draw far out in the tail must not turn friction into a push.
    const double factor = std::max(0.0, 1 + options.scatter * scatter.normal(k));
    if (half_space && (probes.empty() || !flat)) {
      probes = probe_all(*solver, law, options, monitor);
      result.probes.insert(result.probes.end(), probes.begin(), probes.end());
    }
    const double mu = half_space ? std::max(0.0, mean_of(probes, &TiltProbe::mu)) : 0;
    std::int64_t contacts = 0;  // under the greatest load of the trial
    const auto friction = [&](double normal_force) {
      if (half_space) return factor * mu * normal_force;
      const State state = solver->press({PressBy::load, normal_force * tile_share, {}}, monitor);
      contacts = std::max(contacts, state.contacts());
      return factor * std::max(0.0, law.on(state, options.rest).force) / tile_share;
    };
    result.trials.push_back(slip_angle(friction, options.stage));
    if (!half_space) fewest = std::min(fewest, contacts);
    task.advance();
  }

  std::vector<double> coefficients;
  result.slipped = true;
  // Taken about the first trial, so that equal trials have exactly their own mean.
  const SlipAngle first = result.trials.front();
  result.angle = first.angle;
  result.held = first.held;
  for (const SlipAngle& trial : result.trials) {
    result.angle += (trial.angle - first.angle) / options.repeats;
    result.held += (trial.held - first.held) / options.repeats;
    result.slipped = result.slipped && trial.slipped;
    coefficients.push_back(tangent(trial.held));
  }
  result.mu = tangent(result.held);
  if (half_space) result.area_per_load = mean_of(result.probes, &TiltProbe::area_per_load);
  result.spread = standard_deviation(coefficients);
  result.note = note_on(result, options, flat);
  if (fewest < std::min(enough_contacts, static_cast<std::int64_t>(bench.lower().grid().nodes())))
    add_sentence(result.note, "the weight rests on " + std::to_string(fewest) +
                                  (fewest == 1 ? " node" : " nodes") +
                                  " only: mu is that of their areas and changes with the grid");
  if (options.rest)
    add_sentence(result.note, "at rest for " + format_quantity(*options.rest, dimension::time) +
                                  ", tau0 grew by a factor of " +
                                  format_short(strengthening(*pair.scene().sliding.ageing, options.rest)));
  return result;
}

}  // namespace asperity
