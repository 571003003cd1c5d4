// SPDX-License-Identifier: GPL-3.0-or-later
// Predictions of `explain` against presses on tiles of up to 256 cells a side, cell aspects up to 1000.
// Trials are not counted as cost and leave the pair unchanged; a trial on all cells predicts the exact
// number of transforms. Of 1800 scenes (150 each of seeds 1, 5 to 8, 41, 42, 51 and 53 to 56), in percent,
//
//                                             within a factor of two   under a quarter
//     by pressure, 1798 presses               100                      0
//     by approach, 1738                       99.9                     0
//     by flattening, 1674                     99.8                     0
//     of bodies that attract, 744             99.9                     0
//
// The bar does not hold on tiles of up to 1000 cells a side (seeds 61 and 62, cells=1000), some predicted
// from coarser grids: 93.7 to 100 and 0 to 1.3. Coarse trials alone, at most 96² cells (seeds 41 and 42):
// 96.0 to 98.1 and 0 to 0.4; larger tiles 89.5 to 95.7 and 0 to 1.0.
//
//   ASPERITY_FIT=1 test_properties family=explain scenes=300 seed=31
//
// prints the shares and the best constants a, b of engine/accuracy/expected_transforms.cpp.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/accuracy/expected_transforms.hpp"
#include "engine/contact/effects/adhesion.hpp"
#include "engine/contact/effects/plasticity.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/error.hpp"
#include "tests/stability/properties/property.hpp"

namespace asperity::stability {

namespace {

struct Pressed {
  ExpectedTransforms expected, by_few_cells;
  double taken = 0;
  bool fewer = false;  // the tile exceeds the coarse trial
};
double octaves(const ExpectedTransforms& expected, double taken) {
  return std::log2(std::max(expected.transforms, 1.0) / std::max(taken, 1.0));
}
// For one control, and required shares for larger tiles by coarse trials.
struct Controls {
  const char* name;
  double within_two, under_a_quarter;
  std::vector<Pressed> presses{};
};
constexpr TrialEffort few_cells{.most_nodes = 96 * 96};
std::array<Controls, 4>& by_control() {
  static std::array<Controls, 4> of_run = {{{"pressure", 0.92, 0.01},
                                            {"approach", 0.92, 0.015},
                                            {"flatten", 0.84, 0.025},
                                            {"pressure or approach of bodies that attract", 0.9, 0.02}}};
  return of_run;
}
// Required of coarse trials on all tiles; `explain` must reach `bar`, never under a quarter.
constexpr double within_two_of_all = 0.9, under_a_quarter_of_all = 0.015, bar = 0.9;
// In standard deviations.
constexpr double deviations = 3;

Verdict foretell(const Scene& scene, PressBy by, double value, const State* known,
                 std::vector<Pressed>& presses) {
  const PressRequest request{by, value, {}};
  SpecimenPair pair(scene);
  const std::string line = "print(c:copy():explain{ " + std::string(name(by)) + "=" + exact(value) + " })\n";
  const double before = cost::transforms();
  Pressed now;
  const auto expected = [&](const TrialEffort& effort) {
    return expected_transforms(pair.scene(), pair.solver()->geometry(), pair.plan(), request, effort);
  };
  now.expected = expected({});
  now.by_few_cells = expected(few_cells);
  if (cost::transforms() != before)
    return Broken{"explain counts nothing", exact(cost::transforms() - before) + " transforms", line};
  now.fewer = now.by_few_cells.tried_on != scene.lower.grid();
  try {
    now.taken =
        known != nullptr ? known->cost().total.transforms : pair.press(request).cost().total.transforms;
  } catch (const Error&) {  // `controls` tests refusals
    return {};
  }
  presses.push_back(now);
  const bool whole = now.expected.tried_on == scene.lower.grid();
  if (!whole || !now.expected.ended || now.taken == now.expected.transforms) return {};
  return Broken{"a press takes what its trial on all cells did",
                exact(now.taken) + " transforms, and " + exact(now.expected.transforms) + " were said", line};
}

std::optional<State> pressed_if_solved(const Trial& trial) {
  try {
    return pressed(trial);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::not_converged) throw;
    return {};
  }
}

// Adhesion with a range of the order of the roughness. Such presses take thousands of transforms: few,
// nearly square cells.
Verdict foretell_attraction(const Trial& trial, const State& state, std::uint64_t salt) {
  constexpr double most_nodes = 150 * 150, tolerance = 1e-6;
  const Grid& grid = trial.scene.lower.grid();
  const double rms = rms_height(state);
  if (trial.scene.effects.find<PlasticityOptions>() || static_cast<double>(grid.nodes()) > most_nodes ||
      grid.hx() != grid.hy() || !(rms > 0))
    return {};
  const Stream draw(salt, "attraction");
  const double modulus = std::get<HalfSpaceOperator>(SpecimenPair(trial.scene).plan().elasticity).modulus;
  Scene scene = trial.scene;
  scene.effects.set(AdhesionOptions{});
  scene.effects.find<AdhesionOptions>()->work =
      modulus * rms * rms / grid.size_x * std::pow(10.0, draw.uniform(0, -1, 1.5));
  scene.effects.find<AdhesionOptions>()->range = rms * std::pow(10.0, draw.uniform(1, -1, 0.5));
  scene.accuracy.tolerance = std::max(scene.accuracy.tolerance, tolerance);
  std::vector<Pressed>& presses = by_control()[3].presses;
  try {
    if (Verdict verdict = foretell(scene, PressBy::pressure, trial.pressure, nullptr, presses))
      return verdict;
    return foretell(scene, PressBy::approach, state.approach(), nullptr, presses);
  } catch (const Error& error) {  // adhesion too strong
    if (error.code() != ErrorCode::bad_value) throw;
    return {};
  }
}

Verdict check(const Trial& trial, std::uint64_t salt) {
  std::vector<Pressed>& pressure = by_control()[0].presses;
  std::vector<Pressed>& approach = by_control()[1].presses;
  std::vector<Pressed>& flatten = by_control()[2].presses;
  const std::optional<State> solved = pressed_if_solved(trial);
  if (!solved) return {};
  const State& state = *solved;
  const Scene& scene = trial.scene;
  if (Verdict verdict = foretell(scene, PressBy::pressure, trial.pressure, &state, pressure)) return verdict;
  if (Verdict verdict = foretell(scene, PressBy::approach, state.approach(), nullptr, approach))
    return verdict;
  if (Verdict verdict = foretell_attraction(trial, state, salt)) return verdict;
  if (!(state.geometry().peak_to_valley() > 0) || state.flatten() == 0) return {};
  return foretell(scene, PressBy::flatten, state.flatten(), nullptr, flatten);
}

struct Shares {
  int presses = 0, within_two = 0, under_a_quarter = 0, over_four = 0;
  double of(int count) const { return presses > 0 ? static_cast<double>(count) / presses : 0; }
  void take(double octaves) {
    ++presses;
    if (std::abs(octaves) <= 1) ++within_two;
    if (octaves < -2) ++under_a_quarter;
    if (octaves > 2) ++over_four;
  }
};

// Minimises the mean |log2(predicted / actual)| over a and b.
void fit(const Controls& control) {
  double best = 1e300, best_a = 0, best_b = 0;
  for (int i = -20; i <= 60; ++i)
    for (int j = -50; j <= 100; ++j) {
      const double a = 0.02 * i, b = 0.02 * j;
      double sum = 0;
      for (const Pressed& press : control.presses) {
        const ExpectedTransforms& e = press.by_few_cells;
        if (!press.fewer || !e.ended || !e.refused.empty() || !(e.tried > 0) || !(press.taken > 0)) continue;
        sum += std::abs(std::log2(e.tried / press.taken) + e.halvings * (a + b * e.roughness));
      }
      if (sum < best) best = sum, best_a = a, best_b = b;
    }
  std::printf("explain: fit by %s {%.2f, %.2f}\n", control.name, best_a, best_b);
}

void print(const Controls& control, const Shares& found, const char* which) {
  std::printf(
      "explain: by %s, %d presses%s: within a factor of two %.3g %%, under a quarter %.3g %%, over four "
      "times %.3g %%\n",
      control.name, found.presses, which, 100 * found.of(found.within_two),
      100 * found.of(found.under_a_quarter), 100 * found.of(found.over_four));
}

Verdict off(const Controls& control, const Shares& found, const char* what, int count) {
  return Broken{std::string(what) + " by " + control.name,
                std::to_string(count) + " of " + std::to_string(found.presses)};
}

Verdict judged_by_few_cells(const Controls& control, bool fewer) {
  Shares found;
  for (const Pressed& press : control.presses)
    if (press.fewer || !fewer) found.take(octaves(press.by_few_cells, press.taken));
  print(control, found, fewer ? " of larger tiles, by few cells" : ", by few cells");
  const double share = fewer ? control.within_two : within_two_of_all,
               rare = fewer ? control.under_a_quarter : under_a_quarter_of_all;
  const double n = found.presses;
  if (found.within_two < n * share - deviations * std::sqrt(n * share * (1 - share)))
    return off(control, found, "within a factor of two by few cells", found.within_two);
  if (found.under_a_quarter > 1 + n * rare + deviations * std::sqrt(n * rare))
    return off(control, found, "under a quarter by few cells", found.under_a_quarter);
  return {};
}

Verdict judged(const Controls& control) {
  Shares found, by_fewer;
  for (const Pressed& press : control.presses) {
    found.take(octaves(press.expected, press.taken));
    if (press.expected.halvings > 0 && press.expected.ended)
      by_fewer.take(octaves(press.expected, press.taken));
  }
  print(control, found, "");
  if (by_fewer.presses > 0) print(control, by_fewer, " that are told by fewer cells");
  if (found.within_two < bar * found.presses)
    return off(control, found, "within a factor of two", found.within_two);
  if (found.under_a_quarter > 0) return off(control, found, "under a quarter", found.under_a_quarter);
  return {};
}

Verdict after() {
  Verdict verdict;
  const auto take = [&](Verdict found) {
    if (found) verdict = std::move(found);
  };
  for (const Controls& control : by_control()) {
    take(judged(control));
    for (const bool fewer : {false, true}) take(judged_by_few_cells(control, fewer));
  }
  if (std::getenv("ASPERITY_FIT") != nullptr)
    for (std::size_t k = 0; k < 3; ++k) fit(by_control()[k]);
  return verdict;
}

}  // namespace

const Family explain{"explain",
                     {.model = Wanted::Model::half_space, .lightest = 1e-6, .most_cells = 256, .longest = 3},
                     check,
                     30,
                     after};

}  // namespace asperity::stability
