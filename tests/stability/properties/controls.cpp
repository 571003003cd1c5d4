// SPDX-License-Identifier: GPL-3.0-or-later
// The approach, indentation or flattening of a press, requested from fresh bodies, must return its load
// within the bounds, for about as many transforms. Unreachable values (beyond full contact of a periodic
// tile, on a flat) are refused by name. Cell aspects up to 1000.
// Measurements: docs/stability/random_scenes.md.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <string>
#include <vector>

#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "tests/stability/properties/property.hpp"

namespace asperity::stability {

namespace {

// Transforms relative to the press by pressure: expensive above 10 times + 60; median at most 3.
constexpr double most_times = 10, most_beside = 60, most_times_in_the_middle = 3;
// From this many presses on, one more expensive or lost press is allowed.
constexpr int many_presses = 100;
// Bytes above the memory that `explain` predicts.
constexpr double most_beyond = 1 << 20;

// Presses on cells at most `longest` times longer than wide, and the shares that may be expensive or lost.
struct Cells {
  const char* name;
  double longest, most_dear, most_lost;
  int presses = 0, dear = 0, lost = 0;
};
struct Counts {
  std::vector<double> times;  // relative to the press by pressure
  Cells cells[3] = {
      {"up to 10", 10, 0.001, 0}, {"10 to 300", 300, 0.005, 0}, {"over 300", infinity, 0.02, 0.02}};
};
Counts& counts() {
  static Counts of_run, of_smaller;
  return counts_scenes ? of_run : of_smaller;
}

Cells& cells_of(const Trial& trial) {
  const Grid& grid = trial.scene.lower.grid();
  const double aspect = std::max(grid.hx(), grid.hy()) / std::min(grid.hx(), grid.hy());
  return *std::find_if(std::begin(counts().cells), std::end(counts().cells),
                       [&](const Cells& cells) { return aspect <= cells.longest; });
}

// Whether rounding prevents the tolerance.
bool beyond_doubles(const Trial& trial, PressBy by, double value) {
  Trial best = trial;
  best.scene.accuracy.on_failure = Accuracy::OnFailure::best;
  return doubles_hold_no_more(best, SpecimenPair(best.scene).press({by, value, {}}));
}

bool full(const State& state) {
  const Grid& grid = state.grid();
  return state.contacts() == static_cast<std::int64_t>(grid.nodes());
}

Verdict compare(const Trial& trial, const State& by_pressure, PressBy by, double value, double bytes_said) {
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
    if (error.code() == ErrorCode::not_converged) {
      if (refuses_hardening(error) || beyond_doubles(trial, by, value)) return {};
      ++cells_of(trial).presses;
      ++cells_of(trial).lost;
      std::printf("controls: scene %llu not solved by %s: %s\n",
                  static_cast<unsigned long long>(scene_in_turn), key.c_str(), error.what());
      return {};
    }
    return Broken{"pressed by " + key + " to what a pressure brought", error.what(), line};
  }
  const double tolerance = trial.scene.accuracy.tolerance;
  const double reached = by == PressBy::flatten    ? again.flatten()
                         : by == PressBy::approach ? again.approach()
                                                   : again.indentation();
  if (!(std::abs(reached - value) <= 2 * tolerance * value))
    return Broken{key + " is what was asked for", exact(reached) + " of " + exact(value), line};
  const double taken = again.cost().total.transforms, before = by_pressure.cost().total.transforms;
  ++cells_of(trial).presses;
  if (taken > most_times * before + most_beside) {
    ++cells_of(trial).dear;
    if (counts_scenes)
      std::printf(
          "controls: scene %llu dear by %s: %.0f transforms, by pressure %.0f; cells 1:%.3g; %s; %s\n",
          static_cast<unsigned long long>(scene_in_turn), key.c_str(), taken, before,
          again.grid().hy() / again.grid().hx(), trial.heights.c_str(), again.solver().c_str());
  }
  if (before > 0) counts().times.push_back(taken / before);
  const auto bytes = static_cast<double>(again.cost().total.bytes);
  if (bytes > bytes_said + most_beyond)
    return Broken{"memory said beforehand", exact(bytes_said) + " of " + exact(bytes) + " bytes", line};
  // The stiffness converts the error bound of an approach to load.
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
  const Plan plan = SpecimenPair(trial.scene).plan();
  const auto said = static_cast<double>(plan.bytes_peak());
  if (Verdict verdict = compare(trial, state, PressBy::approach, state.approach(), said)) return verdict;
  if (!(state.geometry().peak_to_valley() > 0)) return {};
  if (Verdict verdict = compare(trial, state, PressBy::indentation, state.indentation(), said))
    return verdict;
  if (state.flatten() == 0) return {};
  const auto more = static_cast<double>(plan.bytes_to_flatten);
  return compare(trial, state, PressBy::flatten, state.flatten(), said + more);
}

Verdict after() {
  Counts& all = counts();
  if (all.times.empty()) return {};
  const auto middle = all.times.begin() + static_cast<std::ptrdiff_t>(all.times.size() / 2);
  std::nth_element(all.times.begin(), middle, all.times.end());
  std::printf("controls: median %.3g times the transforms by pressure\n", *middle);
  const bool many = all.times.size() > many_presses;
  if (many && *middle > most_times_in_the_middle) return Broken{"transforms in the middle", exact(*middle)};
  const int one = many ? 1 : 0;
  std::string wrong;
  for (const Cells& cells : all.cells) {
    const std::string where = std::string("on cells ") + cells.name + " times longer than wide";
    std::printf("controls: %s %d presses, %d dear, %d not solved\n", where.c_str(), cells.presses, cells.dear,
                cells.lost);
    if (cells.dear > one + cells.most_dear * cells.presses ||
        cells.lost > (cells.most_lost > 0 ? one + cells.most_lost * cells.presses : 0))
      wrong = where;
  }
  if (!wrong.empty()) return Broken{"dear or lost presses " + wrong, "more than allowed"};
  return {};
}

}  // namespace

const Family controls{"controls",
                      {.model = Wanted::Model::half_space, .lightest = 1e-6, .most_cells = 64, .longest = 3},
                      check,
                      500,
                      after};

}  // namespace asperity::stability
