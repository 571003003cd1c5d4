// SPDX-License-Identifier: GPL-3.0-or-later
// The same state by its pressure and by what it then reports: pressed again by that approach, indentation or
// flattening, fresh bodies come to the load within the bounds, for about as many transforms. What no load
// reaches (past full contact of a periodic tile, on a flat) is refused by name, and nothing else is. Grids of
// 1 to 256 cells a side, cells up to a thousand times longer than wide or wider than long.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "tests/stability/properties/property.hpp"

namespace asperity::stability {

namespace {

// Transforms of a press, beside those by pressure.
constexpr double most_times = 10, most_beside = 60, most_times_in_the_middle = 3;
// What `explain` says, beside those taken: the least share of them that it may say, and how many presses it
// is within a factor of two of.
constexpr double least_said = 0.25, said_within_two = 0.9;

struct Counts {
  std::vector<double> times;  // by each control, of those by pressure
  int presses = 0, within_two = 0;
};
Counts& counts() {
  static Counts of_run;
  return of_run;
}

// Whether any more load would bring the bodies no nearer, or no flatter.
bool full(const State& state) {
  const Grid& grid = state.grid();
  return state.contacts() == static_cast<std::int64_t>(grid.nodes());
}

Verdict compare(const Trial& trial, const State& by_pressure, PressBy by, double value, double said) {
  const std::string key(name(by));
  const std::string line =
      "local again = c:copy():press{ " + key + "=" + exact(value) +
      " }\nprint(st.pressure, st.cost.transforms, again.pressure, again.cost.transforms)\n";
  State again = by_pressure;
  try {
    again = SpecimenPair(trial.scene).press({by, value, {}});
  } catch (const Error& error) {
    const bool named = error.code() == ErrorCode::infeasible || error.code() == ErrorCode::bad_value;
    if (named && full(by_pressure)) return {};
    return Broken{"pressed by " + key + " to what a pressure brought", error.what(), line};
  }
  const double tolerance = trial.scene.accuracy.tolerance;
  const double reached = by == PressBy::flatten    ? again.flatten()
                         : by == PressBy::approach ? again.approach()
                                                   : again.indentation();
  if (!(std::abs(reached - value) <= 2 * tolerance * value))
    return Broken{key + " is what was asked for", exact(reached) + " of " + exact(value), line};
  const double taken = again.cost().total.transforms, before = by_pressure.cost().total.transforms;
  if (taken > most_times * before + most_beside)
    return Broken{"transforms by " + key, exact(taken) + ", by pressure " + exact(before), line};
  if (before > 0) counts().times.push_back(taken / before);
  ++counts().presses;
  if (taken <= 2 * said && said <= 2 * taken) ++counts().within_two;
  if (said < least_said * taken)
    return Broken{"transforms said beforehand", exact(said) + " of " + exact(taken), line};
  // The loads, within what both solves leave open: that of the approach turned into load by the stiffness.
  if (by == PressBy::flatten || full(by_pressure)) return {};
  const double stiffness = std::max(again.stiffness(), by_pressure.stiffness());
  const double open = again.algebraic_error().pressure.value_or(infinity) +
                      2 * stiffness * (by_pressure.algebraic_error().approach + 1e-15 * value);
  const double digits = 1e-13 * by_pressure.pressure();
  if (!(std::abs(again.pressure() - by_pressure.pressure()) <= open + digits) && !std::isnan(open))
    return Broken{
        "the pressure of that " + key,
        exact(again.pressure()) + ", and it was " + exact(by_pressure.pressure()) + ", within " + exact(open),
        line};
  return {};
}

Verdict check(const Trial& trial, std::uint64_t) {
  const State state = pressed(trial);
  const double said = SpecimenPair(trial.scene).plan().transforms;
  if (Verdict verdict = compare(trial, state, PressBy::approach, state.approach(), said)) return verdict;
  if (!(state.geometry().peak_to_valley() > 0)) return {};
  if (Verdict verdict = compare(trial, state, PressBy::indentation, state.indentation(), said))
    return verdict;
  if (state.flatten() == 0) return {};
  return compare(trial, state, PressBy::flatten, state.flatten(), said);
}

Verdict after() {
  Counts& all = counts();
  if (all.times.empty()) return {};
  const auto middle = all.times.begin() + static_cast<std::ptrdiff_t>(all.times.size() / 2);
  std::nth_element(all.times.begin(), middle, all.times.end());
  const double share = static_cast<double>(all.within_two) / std::max(1, all.presses);
  std::printf(
      "controls: median %.3g times the transforms by pressure; said within a factor of two in %.3g %%\n",
      *middle, 100 * share);
  if (*middle > most_times_in_the_middle) return Broken{"transforms in the middle", exact(*middle)};
  if (share < said_within_two) return Broken{"transforms said within a factor of two", exact(share)};
  return {};
}

}  // namespace

const Family controls{"controls",
                      {.model = Wanted::Model::half_space, .lightest = 1e-6, .most_cells = 256, .longest = 3},
                      check,
                      300,
                      after};

}  // namespace asperity::stability
