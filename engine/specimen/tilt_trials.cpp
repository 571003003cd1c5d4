// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/specimen/tilt_trials.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <span>

#include "engine/contact/state_limits.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

// Below, area and friction depend on the grid.
constexpr std::int64_t enough_contacts = 50;

void check_trials(const TiltTrialOptions& options) {
  check(options.stage);
  require_positive("specimen_area", options.specimen_area, "m^2", "give a finite area above zero");
  require(options.scatter >= 0 && options.scatter < 1, "scatter", options.scatter, "",
          "it is a relative standard deviation: give a number from 0 to below 1");
  if (options.probe_pressures.empty() ||
      !std::all_of(options.probe_pressures.begin(), options.probe_pressures.end(),
                   [](double p) { return p > 0 && std::isfinite(p); }))
    throw Error(ErrorCode::bad_value, "`probe_pressure` holds a pressure that is not finite and above zero",
                "give one or more, such as { \"1 MPa\", \"3 MPa\" }");
  require(options.repeats >= 1 && options.repeats <= 100000, "repeats", options.repeats, "",
          "give a whole number from 1 to 100000");
}

TiltProbe probe_of(const State& state, const JunctionLaw& law, const TiltTrialOptions& options) {
  const FrictionResult friction = law.on(state, options.rest);
  const double corrected = state.corrected_area_fraction() / state.area_fraction();
  return {
      state.pressure(),
      state.contacts(),
      state.plastic_change().has_value(),
      state.corrected_area_fraction() / state.pressure(),
      (friction.adhesive_force * corrected + friction.load_force + friction.interlocking_force.value_or(0)) /
          state.load(),
      state.attraction() / state.load(),
      state.spots8() == 1,
      state_limits(state)};
}

// At a pressure that the grid resolves.
TiltProbe probe(const Solver& contact, const JunctionLaw& law, double pressure,
                const TiltTrialOptions& options, Monitor& monitor) {
  const std::int64_t nodes = contact.geometry().facing();
  for (;; pressure *= 2) {
    const State state = contact.press({PressBy::pressure, pressure, {}}, monitor);
    if (state.contacts() >= std::min(enough_contacts, nodes)) return probe_of(state, law, options);
  }
}

std::vector<TiltProbe> probe_all(const Solver& contact, const JunctionLaw& law,
                                 const TiltTrialOptions& options, Monitor& monitor) {
  std::vector<TiltProbe> probes;
  for (const double pressure : options.probe_pressures)
    probes.push_back(probe(contact, law, pressure, options, monitor));
  return probes;
}

// Friction over load of a half-space contact under a resolved weight: solved under the weight, at steps of a
// sixth below, and on request; linear between.
class UnderTheWeight {
 public:
  // Pressures on the tile.
  UnderTheWeight(const Solver& contact, const JunctionLaw& law, const TiltTrialOptions& options, double least,
                 double weight, Monitor& monitor)
      : contact_(contact), law_(law), options_(options), monitor_(monitor), least_(least), lowest_(weight) {
    solve(weight);
  }

  double mu(double pressure) {
    constexpr double step = 5.0 / 6;
    while (lowest_ > pressure) {
      lowest_ = std::max(least_, step * lowest_);
      solve(lowest_);
    }
    const auto above = known_.lower_bound(pressure);
    if (above == known_.end()) return std::prev(above)->second.mu;
    if (above->first == pressure || above == known_.begin()) return above->second.mu;
    const auto below = std::prev(above);
    const double share = (pressure - below->first) / (above->first - below->first);
    return below->second.mu + share * (above->second.mu - below->second.mu);
  }
  void solve(double pressure) {
    if (known_.contains(pressure)) return;
    const State state = contact_.press({PressBy::pressure, pressure, {}}, monitor_);
    known_.emplace(pressure, probe_of(state, law_, options_));
  }
  const TiltProbe& at_the_weight() const { return known_.rbegin()->second; }

 private:
  const Solver& contact_;
  const JunctionLaw& law_;
  const TiltTrialOptions& options_;
  Monitor& monitor_;
  double least_, lowest_;
  std::map<double, TiltProbe> known_;  // by pressure
};

double mean_of(std::span<const TiltProbe> probes, double TiltProbe::*quantity) {
  double sum = 0;
  for (const TiltProbe& probe : probes) sum += probe.*quantity;
  return sum / static_cast<double>(probes.size());
}

double least_pressure(std::span<const TiltProbe> probes) {
  double least = probes.front().pressure;
  for (const TiltProbe& probe : probes) least = std::min(least, probe.pressure);
  return least;
}

double greatest_departure(std::span<const TiltProbe> probes, std::size_t a_trial,
                          double TiltProbe::*quantity) {
  double greatest = 0;
  for (std::size_t first = 0; first + a_trial <= probes.size(); first += a_trial) {
    const auto trial = probes.subspan(first, a_trial);
    const double mean = mean_of(trial, quantity);
    for (const TiltProbe& probe : trial)
      if (mean != 0) greatest = std::max(greatest, std::abs(probe.*quantity / mean - 1));
  }
  return greatest;
}

constexpr double noticeable_departure = 0.025;  // of area per load: two probes differ by 5 %

// One spot whose area is not proportional to load. Many spots differ as much by chance.
bool grows_alone(std::span<const TiltProbe> probes) {
  return std::ranges::all_of(probes, &TiltProbe::lone_spot) &&
         (probes.size() == 1 ||
          greatest_departure(probes, probes.size(), &TiltProbe::area_per_load) > noticeable_departure);
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
    const double departs =
        greatest_departure(result.probes, options.probe_pressures.size(), &TiltProbe::area_per_load);
    const std::string apart = format_short(200 * departs, 2) + " % between the probes";
    if (!result.at_weight.empty()) {
      const double pressure = result.at_weight.front().pressure;
      add_sentence(note,
                   "the weight presses the tile with " + format_quantity(pressure, dimension::pressure) +
                       (pressure > least_pressure(result.probes)
                            ? ", above the smallest probe pressure, so the contact was solved under it"
                            : " on a lone spot, whose area per load differs by " + apart +
                                  ", so the contact was solved under it") +
                       "; tau0 is an effective, calibrated number, so only ratios of mu are predictions");
      if (std::any_of(result.at_weight.begin(), result.at_weight.end(),
                      [](const TiltProbe& p) { return p.yields; }))
        add_sentence(note,
                     "spots yield under the weight, which bounds area per load by one over the hardness");
      return note;
    }
    if (std::any_of(result.probes.begin(), result.probes.end(), [](const TiltProbe& p) { return p.yields; }))
      add_sentence(note,
                   "spots yield under the probe pressure, which bounds area per load by one over the "
                   "hardness; without " +
                       effects_that(Effect::Acts::bounds_pressure) + " the probe is elastic");
    if (const double pull = mean_of(result.probes, &TiltProbe::attraction); pull > 0)
      add_sentence(note, "the bodies attract each other by " + format_short(pull, 3) +
                             " of the load at the probe pressures, which is taken to hold down to the "
                             "weight; bodies that stick without a load hold more");
    add_sentence(note,
                 "real area per load is taken from the probe pressures down to the weight; tau0 is an "
                 "effective, calibrated number, so only ratios of mu are predictions");
    if (departs > noticeable_departure)
      add_sentence(note, "area per load differs by " + apart + ", and is as uncertain: take finer cells");
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
  check_rest(options.rest, pair.scene().effects);
  SpecimenPair bench = pair;
  const bool flat = bench.upper_is_flat();
  const double tile_share =
      bench.lower().grid().area() / options.specimen_area.value_or(bench.lower().grid().area());
  const Stream scatter(options.seed, "tilt scatter");

  TiltResult result;
  Task task(monitor, "tilt stage", options.repeats);
  const bool half_space = bench.scene().elasticity.model().moves_every_node;
  std::vector<TiltProbe> probes;
  std::optional<UnderTheWeight> weight;
  const double tile = bench.lower().grid().area();
  const double weight_pressure = options.stage.mass * options.stage.gravity * tile_share / tile;
  std::int64_t fewest = std::numeric_limits<std::int64_t>::max();
  for (int trial = 0; trial < options.repeats; ++trial) {
    const auto k = static_cast<std::uint64_t>(trial);
    if (!flat) bench.place(tilt_placement(options, trial));
    const std::shared_ptr<const Solver> solver = bench.solver();
    // A draw in the far tail must not make friction negative.
    const double factor = std::max(0.0, 1 + options.scatter * scatter.normal(k));
    if (half_space && (probes.empty() || !flat)) {
      probes = probe_all(*solver, law, options, monitor);
      result.probes.insert(result.probes.end(), probes.begin(), probes.end());
    }
    const double mu = half_space ? std::max(0.0, mean_of(probes, &TiltProbe::mu)) : 0;
    // Lighter loads follow from the probes.
    double resolved = half_space ? least_pressure(probes) : 0;
    if (half_space && tile_share == 1 && grows_alone(probes))
      resolved = 0.01 * std::min(resolved, weight_pressure);
    if (!flat) weight.reset();
    if (half_space && weight_pressure > resolved && !weight)
      weight.emplace(*solver, law, options, resolved, weight_pressure, monitor);
    std::int64_t contacts = 0;  // under the greatest load of the trial
    const auto friction = [&](double normal_force) {
      if (half_space) {
        const double pressure = std::min(normal_force * tile_share / tile, weight_pressure);
        return factor * (weight && pressure > resolved ? std::max(0.0, weight->mu(pressure)) : mu) *
               normal_force;
      }
      const State state = solver->press({PressBy::load, normal_force * tile_share, {}}, monitor);
      contacts = std::max(contacts, state.contacts());
      return factor * std::max(0.0, law.on(state, options.rest).force) / tile_share;
    };
    SlipAngle slip = slip_angle(friction, options.stage);
    if (weight) {
      // Repeats with a solve at the load of slip until the slip angle agrees. Area counts nodes: if a node
      // detaches between two loads, both may be solved.
      constexpr int most_rounds = 12;
      double before = weight_pressure;
      for (int round = 0; round < most_rounds; ++round) {
        const double pressure = weight_pressure * elementary::cos(slip.angle);
        if (!slip.slipped || !(pressure > resolved) || pressure == before) break;
        weight->solve(pressure);
        before = pressure;
        slip = slip_angle(friction, options.stage);
      }
      result.at_weight.push_back(weight->at_the_weight());
    }
    result.trials.push_back(slip);
    if (!half_space) fewest = std::min(fewest, contacts);
    task.advance();
  }

  std::vector<double> coefficients;
  result.slipped = true;
  // Relative to the first trial: equal trials have exactly their own mean.
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
  if (half_space) {
    const bool solved = !result.at_weight.empty();
    result.area_per_load = mean_of(solved ? result.at_weight : result.probes, &TiltProbe::area_per_load);
    if (!solved && options.probe_pressures.size() > 1)
      result.probe_spread = greatest_departure(result.probes, options.probe_pressures.size(), &TiltProbe::mu);
  }
  result.spread = standard_deviation(coefficients);
  result.note = note_on(result, options, flat);
  WarningKinds kinds;
  for (const TiltProbe& probe : result.at_weight.empty() ? result.probes : result.at_weight)
    for (const std::string& limit : probe.limits)
      if (kinds.is_first(limit)) {
        add_sentence(result.note, limit);
        monitor.warn("tilt stage: " + limit);
      }
  if (fewest < std::min(enough_contacts, static_cast<std::int64_t>(bench.lower().grid().nodes())))
    add_sentence(result.note, "the weight rests on " + std::to_string(fewest) +
                                  (fewest == 1 ? " node" : " nodes") +
                                  " only: mu is that of their areas and changes with the grid");
  if (options.rest)
    add_sentence(result.note, "at rest for " + format_quantity(*options.rest, dimension::time) +
                                  ", tau0 grew by a factor of " +
                                  format_short(strengthening(pair.scene().effects, options.rest)));
  if (result.trials.size() > 1)
    add_sentence(
        result.note,
        "`spread` is of trials on one pair of faces: what other seeds or specimens give is not in it");
  return result;
}

}  // namespace asperity
