// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/experiment/tilt_trials.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/error.hpp"
#include "engine/core/random.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

void check_trials(const TiltTrialOptions& options) {
  check(options.stage);
  if (options.specimen_area && !(*options.specimen_area > 0 && std::isfinite(*options.specimen_area)))
    throw Error(ErrorCode::bad_value, "`specimen_area` is " + format_short(*options.specimen_area) + " m^2",
                "give a finite area above zero");
  if (!(options.scatter >= 0 && options.scatter < 1))
    throw Error(ErrorCode::bad_value, "`scatter` is " + format_short(options.scatter),
                "it is a relative standard deviation: give a number from 0 to below 1");
  if (options.repeats < 1 || options.repeats > 100000)
    throw Error(ErrorCode::bad_value, "`repeats` is " + std::to_string(options.repeats),
                "give a whole number from 1 to 100000");
}

double tangent(double angle) {
  return angle >= 0.5 * std::numbers::pi ? std::numeric_limits<double>::infinity() : std::tan(angle);
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
  if (flat && result.trials.size() > 1) {
    if (!note.empty()) note += "; ";
    note += options.scatter > 0 ? "the counter-body is flat: trials differ only by `scatter`"
                                : "the counter-body is flat and `scatter` is 0: all trials are the same";
  }
  return note;
}

}  // namespace

TiltResult raise(const SpecimenPair& pair, const JunctionLaw& law, const TiltTrialOptions& options,
                 Monitor& monitor) {
  check_trials(options);
  SpecimenPair bench = pair;
  const bool flat = bench.upper_is_flat();
  const double tile_share =
      bench.lower().grid().area() / options.specimen_area.value_or(bench.lower().grid().area());
  const Stream scatter(options.seed, "tilt scatter"), placements(options.seed, "tilt placement");

  TiltResult result;
  Task task(monitor, "tilt stage", options.repeats);
  for (int trial = 0; trial < options.repeats; ++trial) {
    const auto k = static_cast<std::uint64_t>(trial);
    if (!flat) bench.place(placements.bits(k));
    const std::shared_ptr<const Solver> solver = bench.solver();
    // A draw far out in the tail must not turn friction into a push.
    const double factor = std::max(0.0, 1 + options.scatter * scatter.normal(k));
    const auto friction = [&](double normal_force) {
      const State state = solver->press({PressBy::load, normal_force * tile_share, {}}, monitor);
      return factor * law.on(state).force / tile_share;
    };
    result.trials.push_back(slip_angle(friction, options.stage));
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
  result.spread = standard_deviation(coefficients);
  result.note = note_on(result, options, flat);
  return result;
}

}  // namespace asperity
