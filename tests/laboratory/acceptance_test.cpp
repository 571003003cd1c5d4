// SPDX-License-Identifier: GPL-3.0-or-later
// Findings of Hanaor, Gan & Einav (2013) as means over eight pairs: roughness, dimension and real area on
// quartz against stress and events; controls without the findings. Bands from an independent computation.
// 256² cells, shortest wave 16 µm: under-resolved on purpose; ratios hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <vector>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/metrology/dimension_scaling.hpp"
#include "engine/metrology/fractal_dimension.hpp"
#include "engine/metrology/roughness.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "engine/surface/generators/bead_blasted.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::acceptance_test {
namespace {

constexpr double micrometre = 1e-6, megapascal = 1e6;
constexpr int pairs = 8, events = 8;
const std::vector<double> stresses = {20.37, 40.74, 61.11, 101.86, 152.78, 203.72};

enum class Kind { self_affine, bead_blasted };

Surface specimen(Kind kind, std::uint64_t seed, int cells = 256) {
  const Grid grid = make_grid(cells, cells, 1000 * micrometre, 1000 * micrometre);
  const Material& aluminium = named_material("Al-2011");
  if (kind == Kind::bead_blasted) {
    BeadBlastedOptions options;
    options.grid = grid;
    options.ra = 3 * micrometre;
    options.seed = seed;
    return bead_blasted_surface(options).with_material(aluminium);
  }
  SelfAffineOptions options = test::self_affine(grid, 0.8, 16 * micrometre, seed);
  options.ra = 3 * micrometre;
  options.roll_off = 250 * micrometre;
  return self_affine_surface(options).with_material(aluminium);
}

SpecimenPair bench(Kind kind, int pair, int cells = 256) {
  const auto seed = static_cast<std::uint64_t>(2 * pair);
  Scene scene{specimen(kind, seed + 1, cells), specimen(kind, seed + 2, cells), Boundary::periodic,
              HalfSpaceOptions{}, Accuracy{}};
  scene.effects.set(PlasticityOptions{});
  return SpecimenPair(scene);
}

void press(SpecimenPair& pair, double megapascals) {
  pair.press({PressBy::pressure, megapascals * megapascal, {}});
  pair.release();
}

// About 24 integer steps in equal ratios, without duplicates.
std::vector<int> steps_to(double last) {
  std::vector<int> steps;
  for (int k = 0; k < 24; ++k) {
    const int step = static_cast<int>(std::lround(std::pow(last, k / 23.0)));
    if (steps.empty() || step > steps.back()) steps.push_back(step);
  }
  return steps;
}

double excess(const Surface& surface) {
  FractalDimensionOptions options;
  options.along = Along::both;
  options.wrap = true;
  options.offsets = true;
  options.pooled = true;
  options.steps = steps_to(std::round(250 * micrometre / surface.grid().hx()));
  return fractal_dimension(surface, options).D - 1;
}

double area_per_load(const Surface& surface, bool yielding = false) {
  Scene scene{surface, named_material("quartz"), Boundary::periodic, HalfSpaceOptions{}, Accuracy{}};
  if (yielding) scene.effects.set(PlasticityOptions{});
  const State state = SpecimenPair(scene).press({PressBy::pressure, 3 * megapascal, {}});
  return state.corrected_area_fraction() / state.pressure();
}

struct Found {
  double Ra, amplitude, excess, area_per_load;
};
Found measure(const Surface& surface) {
  const Roughness r = roughness(surface);
  return {r.Ra, r.amplitude, excess(surface), area_per_load(surface)};
}

// After each stress on a virgin pair, and after each event.
struct Series {
  std::vector<Found> stress, event;
};
Series run(Kind kind, int pair) {
  Series series;
  const SpecimenPair virgin = bench(kind, pair);
  for (const double stress : stresses) {
    SpecimenPair copy = virgin;
    press(copy, stress);
    series.stress.push_back(measure(copy.lower()));
  }
  SpecimenPair worn = virgin;
  for (int N = 1; N <= events; ++N) {
    if (N > 1) worn.place(static_cast<std::uint64_t>(100 * pair + N));
    press(worn, 152.78);
    series.event.push_back(measure(worn.lower()));
  }
  return series;
}

const std::vector<Series>& all_of(Kind kind) {
  static std::map<Kind, std::vector<Series>> kept;
  std::vector<Series>& all = kept[kind];
  for (int pair = static_cast<int>(all.size()); pair < pairs; ++pair) all.push_back(run(kind, pair));
  return all;
}

// Final over initial value, mean over pairs.
double mean_ratio(Kind kind, std::vector<Found> Series::*which, double Found::*quantity) {
  double sum = 0;
  for (const Series& series : all_of(kind))
    sum += (series.*which).back().*quantity / (series.*which).front().*quantity;
  const double ratio = sum / pairs;
  testing::Test::RecordProperty("ratio", std::to_string(ratio));
  std::cout << "  ratio " << ratio << "\n";
  return ratio;
}

class Laboratory : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(, Laboratory, testing::Values(Kind::self_affine, Kind::bead_blasted),
                         [](const auto& kind) {
                           return std::string(kind.param == Kind::self_affine ? "SelfAffine" : "BeadBlasted");
                         });

TEST_P(Laboratory, RaFallsALittleWithStressInEveryPair) {
  const double ratio = mean_ratio(GetParam(), &Series::stress, &Found::Ra);
  EXPECT_GT(ratio, 0.92);
  EXPECT_LT(ratio, 0.97);
  for (const Series& series : all_of(GetParam()))
    for (std::size_t k = 1; k < series.stress.size(); ++k)
      EXPECT_LT(series.stress[k].Ra, series.stress[k - 1].Ra);
}

TEST_P(Laboratory, RaFallsMoreWithEventsInEveryPair) {
  const double ratio = mean_ratio(GetParam(), &Series::event, &Found::Ra);
  EXPECT_GT(ratio, 0.77);
  EXPECT_LT(ratio, 0.83);
  for (const Series& series : all_of(GetParam()))
    for (std::size_t N = 1; N < series.event.size(); ++N)
      EXPECT_LT(series.event[N].Ra, series.event[N - 1].Ra);
}

TEST_P(Laboratory, AmplitudeFalls) {
  EXPECT_LE(mean_ratio(GetParam(), &Series::stress, &Found::amplitude), 1);
  const double worn = mean_ratio(GetParam(), &Series::event, &Found::amplitude);
  EXPECT_GT(worn, 0.70);
  EXPECT_LT(worn, 0.85);
}

TEST_P(Laboratory, DimensionFallsLittleWithStressAndMoreWithEvents) {
  const double stress = mean_ratio(GetParam(), &Series::stress, &Found::excess);
  EXPECT_GT(stress, 0.86);
  EXPECT_LT(stress, 0.94);
  const double worn = mean_ratio(GetParam(), &Series::event, &Found::excess);
  const bool beads = GetParam() == Kind::bead_blasted;
  EXPECT_GT(worn, beads ? 0.55 : 0.66);
  EXPECT_LT(worn, beads ? 0.62 : 0.72);
}

TEST_P(Laboratory, RealAreaOnQuartzIsFlatInStressAndRisesWithEvents) {
  const double stress = mean_ratio(GetParam(), &Series::stress, &Found::area_per_load);
  EXPECT_GT(stress, 0.85);
  EXPECT_LT(stress, 1.25);
  const double worn = mean_ratio(GetParam(), &Series::event, &Found::area_per_load);
  EXPECT_GT(worn, 1.3);
  EXPECT_GT(worn, stress);
}

TEST_P(Laboratory, EightEventsTakeOverThreeTimesWhatTheGreatestStressTakes) {
  double by_stress = 0, by_events = 0;
  for (const Series& series : all_of(GetParam())) {
    by_stress += 3 * micrometre - series.stress.back().Ra;
    by_events += 3 * micrometre - series.event.back().Ra;
  }
  EXPECT_GT(by_events, 3 * by_stress);
}

TEST_P(Laboratory, DimensionFollowsRaMoreCloselyOverEventsThanOverStress) {
  // Pooled over sets: ln(D−1) on ln(Ra).
  const auto r_squared = [&](std::vector<Found> Series::*which) {
    std::vector<double> x, y;
    for (const Series& series : all_of(GetParam()))
      for (const Found& found : series.*which) {
        x.push_back(std::log(found.Ra));
        y.push_back(std::log(found.excess));
      }
    return fit_line(x, y).r_squared;
  };
  EXPECT_GT(r_squared(&Series::event), r_squared(&Series::stress));
}

TEST_P(Laboratory, ARepeatedEventWithoutTurningTakesNothing) {
  SpecimenPair pair = bench(GetParam(), 0);
  const double first = pair.press({PressBy::pressure, 152.78 * megapascal, {}}).plastic_volume();
  pair.release();
  EXPECT_LT(pair.press({PressBy::pressure, 152.78 * megapascal, {}}).plastic_volume(), 1e-4 * first);
}

TEST_P(Laboratory, WithoutTurningEightEventsAreOne) {
  SpecimenPair pair = bench(GetParam(), 0);
  press(pair, 152.78);
  const double once = roughness(pair.lower()).Ra;
  for (int N = 2; N <= events; ++N) press(pair, 152.78);
  EXPECT_NEAR(roughness(pair.lower()).Ra / once, 1, 1e-5);
}

TEST_P(Laboratory, QuartzSpotsCappedAtHardnessDoNotFeelTheEvents) {
  SpecimenPair pair = bench(GetParam(), 0);
  press(pair, 152.78);
  const double before = area_per_load(pair.lower(), true);
  for (int N = 2; N <= events; ++N) {
    pair.place(static_cast<std::uint64_t>(N));
    press(pair, 152.78);
  }
  EXPECT_LT(area_per_load(pair.lower(), true) / before, 1.3);
}

TEST(LaboratoryGrid, RaAfterFourEventsDoesNotDependOnTheGrid) {
  std::vector<double> Ra;
  for (const int cells : {256, 512, 1024}) {
    SpecimenPair pair = bench(Kind::self_affine, 0, cells);
    for (int N = 1; N <= 4; ++N) {
      // Shifts in metres: the same placement on every grid.
      if (N > 1) pair.shift(125 * micrometre * N, 62.5 * micrometre * N);
      press(pair, 152.78);
    }
    Ra.push_back(roughness(pair.lower()).Ra);
  }
  const auto [least, greatest] = std::minmax_element(Ra.begin(), Ra.end());
  EXPECT_LT(*greatest / *least, 1.005);
}

}  // namespace
}  // namespace asperity::acceptance_test
