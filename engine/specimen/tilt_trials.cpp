// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/specimen/tilt_trials.hpp"

#include <iterator>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/require.hpp"

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
      !std::ranges::all_of(options.probe_pressures, [](double p) { return p > 0 && std::isfinite(p); }))
    refuse("`probe_pressure` holds a pressure that is not finite or not above zero",
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

// At a pressure the grid resolves.
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

// Friction over load of a half-space under a resolved weight: solved there, at steps of a sixth below, and on
// request; linear between.
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
  return std::ranges::min_element(probes, {}, &TiltProbe::pressure)->pressure;
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

// One spot not proportional to load; many spots differ as much by chance.
bool grows_alone(std::span<const TiltProbe> probes) {
  return std::ranges::all_of(probes, &TiltProbe::lone_spot) &&
         (probes.size() == 1 ||
          greatest_departure(probes, probes.size(), &TiltProbe::area_per_load) > noticeable_departure);
}

void add_sentence(std::string& note, const std::string& sentence) {
  if (!note.empty()) note += "; ";
  note += sentence;
}

double tangent(double angle) { return angle >= 0.5 * std::numbers::pi ? infinity : elementary::tan(angle); }

double standard_deviation(const std::vector<double>& values) {
  if (std::ranges::count(values, values.front()) == std::ssize(values)) return 0;
  const auto n = static_cast<double>(values.size());
  if (std::isinf(std::ranges::max(values))) return infinity;
  double mean = 0, squares = 0;
  for (const double v : values) mean += v / n;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / (n - 1));
}

std::string note_on(const TiltResult& result, const TiltTrialOptions& options, bool flat) {
  std::string note;
  const auto slips = std::ranges::count_if(result.trials, &SlipAngle::slipped);
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
    const auto raised = std::ranges::max_element(result.probes, {}, &TiltProbe::pressure);
    const double asked = std::ranges::max(options.probe_pressures);
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
      if (std::ranges::any_of(result.at_weight, &TiltProbe::yields))
        add_sentence(note,
                     "spots yield under the weight, which bounds area per load by one over the hardness");
      return note;
    }
    if (std::ranges::any_of(result.probes, &TiltProbe::yields))
      add_sentence(note,
                   "spots yield under the probe pressure, which bounds area per load by one over the "
                   "hardness; without " +
                       effects_that(Effect::Acts::bounds_pressure) + " the probe is elastic");
    if (const double pull = mean_of(result.probes, &TiltProbe::attraction); pull > 0)
      add_sentence(note, "the bodies attract each other by " + format_short(pull, 3) +
                             " of the load at the probe pressures, and is assumed to be the same at the "
                             "weight; bodies that stick without a load hold more");
    add_sentence(
        note,
        "real area per load is assumed to be the same at the weight as at the probe pressures; tau0 is an "
        "effective, calibrated number, so only ratios of mu are predictions");
    if (departs > noticeable_departure)
      add_sentence(note, "area per load differs by " + apart + ", and is as uncertain: take finer cells");
  }
  return note;
}

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
  const bool half_space = !bench.scene().elasticity.model().is_local;
  std::vector<TiltProbe> probes;
  std::optional<UnderTheWeight> weight;
  const double tile = bench.lower().grid().area();
  const double weight_pressure = options.stage.mass * options.stage.gravity * tile_share / tile;
  std::int64_t fewest = std::numeric_limits<std::int64_t>::max();
  for (int trial = 0; trial < options.repeats; ++trial) {
    const auto k = static_cast<std::uint64_t>(trial);
    if (!flat) bench.place(tilt_placement(options, trial));
    const std::shared_ptr<const Solver> solver = bench.solver();
    // Far tails must not make friction negative.
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
    std::int64_t contacts = 0;  // under the greatest load
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
      // Solves at the load of slip until the slip angle agrees. If a node detaches between two loads, both
      // may be solved.
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
  // Relative to the first: equal trials have exactly their mean.
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
                                  (fewest == 1 ? " node" : " nodes") + " only, so mu depends on the cells");
  if (options.rest)
    add_sentence(result.note, "at rest for " + format_quantity(*options.rest, dimension::time) +
                                  ", tau0 grew by a factor of " +
                                  format_short(strengthening(pair.scene().effects, options.rest)));
  if (result.trials.size() > 1)
    add_sentence(result.note, "`spread` covers trials on one pair of faces, not other seeds or specimens");
  return result;
}

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
