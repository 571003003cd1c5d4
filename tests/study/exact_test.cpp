// SPDX-License-Identifier: GPL-3.0-or-later
// The closed forms against printed numbers, and against each other where they meet: work done is energy
// stored, the friction of a Hertz contact is continuous in its cap, a cap out of reach is no cap.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "engine/study/exact/closed_forms.hpp"

namespace asperity::exact::exact_test {
namespace {

// Work of a load that grows along `approach`, by Simpson's rule in √approach, which both Hertz and the box
// paraboloid are polynomials of.
template <class Load>
double work(double approach, Load load) {
  constexpr int steps = 200;
  const double end = std::sqrt(approach);
  double sum = 0;
  for (int k = 0; k <= steps; ++k) {
    const double s = end * k / steps;
    const double weight = k == 0 || k == steps ? 1 : k % 2 == 1 ? 4 : 2;
    if (k > 0) sum += weight * load(s * s) * 2 * s;
  }
  return sum * end / steps / 3;
}

TEST(Exact, HertzOfTheTables) {
  const Hertz pressed = hertz_at_approach(20, 102, 0.1);
  EXPECT_NEAR(pressed.load, 19.233304448, 5e-10);
  EXPECT_NEAR(pressed.contact_radius, 1.414213562, 5e-10);
  EXPECT_NEAR(pressed.peak_pressure, 4.591613212, 5e-10);
  EXPECT_NEAR(pressed.energy, 0.769332178, 5e-10);
  const Hertz loaded = hertz_under_load(20, 102, 15);
  EXPECT_NEAR(loaded.contact_radius, 1.301749588, 5e-10);
  EXPECT_NEAR(loaded.approach, 0.084727599, 5e-10);
  EXPECT_NEAR(loaded.peak_pressure, 4.226469584, 5e-10);
  EXPECT_NEAR(loaded.energy, 0.508365597, 5e-10);
}

TEST(Exact, WorkDoneIsEnergyStored) {
  const Hertz hertz = hertz_at_approach(20, 102, 0.1);
  EXPECT_NEAR(work(0.1, [](double d) { return hertz_at_approach(20, 102, d).load; }) / hertz.energy, 1, 1e-7);
  const BoxParaboloid box = box_paraboloid_at_approach(3, 7, 0.1);
  EXPECT_NEAR(work(0.1, [](double d) { return box_paraboloid_at_approach(3, 7, d).load; }) / box.energy, 1,
              1e-7);
  // p̄ dδ of a wave, by Simpson's rule in √p̄, at half the pressure of full contact.
  const double full = one_wave(0.01, 1, 1, 1).full_pressure;
  const WavyContact half = one_wave(0.01, 1, 1, full / 2);
  constexpr int steps = 4000;
  double stored = 0;
  for (int k = 1; k <= steps; ++k) {
    const double low = full / 2 * (k - 1) / steps, high = full / 2 * k / steps;
    const double from = k == 1 ? 0 : one_wave(0.01, 1, 1, low).approach;
    stored += 0.5 * (low + high) * (one_wave(0.01, 1, 1, high).approach - from);
  }
  EXPECT_NEAR(stored / half.energy_per_area, 1, 1e-6);
}

TEST(Exact, FrictionOfHertz) {
  const Hertz contact = hertz_under_load(1, 1, 1e-3);
  EXPECT_NEAR(friction(contact, .01, .2, .018), 4.337256e-4, 5e-11);
  EXPECT_NEAR(friction(contact, .01, .2, infinity), 4.593328e-4, 5e-11);
  const double at_peak = .01 + .2 * contact.peak_pressure;
  EXPECT_NEAR(friction(contact, .01, .2, at_peak * (1 - 1e-9)) / friction(contact, .01, .2, infinity), 1,
              1e-12);
  EXPECT_NEAR(friction(contact, .01, .2, .01 * (1 + 1e-12)) / friction(contact, .01, .2, .01), 1, 1e-9);
  EXPECT_EQ(friction(contact, .01, 0, .018), .01 * contact.area);
}

TEST(Exact, OneWaveOfTheTables) {
  const double full = std::numbers::pi * 0.01;
  const double table[][4] = {{.05, .143566, 8.944272, .400107},
                             {.25, .333333, 4, .201713},
                             {.5, .5, 2.828427, .0767132},
                             {.9, .795167, 2.108185, .00258777}};
  for (const auto& [f, area, peak, gap] : table) {
    const WavyContact contact = one_wave(0.01, 1, 1, f * full);
    EXPECT_NEAR(contact.area_fraction, area, 6e-7);
    EXPECT_NEAR(contact.peak_pressure / (f * full), peak, 6e-7);
    EXPECT_NEAR(contact.mean_gap / 0.02, gap, 6e-7);
    EXPECT_NEAR(contact.approach + contact.mean_gap, 0.01, 1e-15);
  }
  const WavyContact all = one_wave(0.01, 1, 1, full * (1 + 1e-12));
  const WavyContact nearly = one_wave(0.01, 1, 1, full * (1 - 1e-12));
  EXPECT_EQ(all.area_fraction, 1);
  EXPECT_NEAR(nearly.area_fraction, 1, 1e-5);
  EXPECT_NEAR(nearly.energy_per_area / all.energy_per_area, 1, 1e-11);
  EXPECT_NEAR(nearly.peak_pressure / all.peak_pressure, 1, 1e-11);
}

TEST(Exact, CrossedWavesTouchEverywhereOrAreRefused) {
  const double full = std::numbers::sqrt2 * std::numbers::pi * 0.01;
  const WavyContact contact = crossed_waves(0.01, 1, 1, full);
  EXPECT_EQ(contact.area_fraction, 1);
  EXPECT_NEAR(contact.energy_per_area, std::numbers::pi * 1e-4 / (4 * std::numbers::sqrt2), 1e-19);
  EXPECT_NEAR(contact.peak_pressure, 2 * full, 1e-16);
  try {
    crossed_waves(0.01, 1, 1, full / 2);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("full contact only, and `pressure` is 0.5 of"),
              std::string::npos)
        << error.what();
  }
}

TEST(Exact, PerssonOfTheTables) {
  for (const auto& [share, area] : {std::pair{.01, .0159566}, {.05, .0796557}, {.1, .158519}}) {
    EXPECT_NEAR(persson_area(1, 1, share, infinity).elastic, area, 6e-7);
    EXPECT_EQ(persson_area(1, 1, share, infinity).capped, 0);
    // The series itself, with an edge that is only just in sight.
    EXPECT_NEAR(persson_area(1, 1, share, 19).elastic, std::erf(std::numbers::sqrt2 * share), 1e-12);
    EXPECT_NEAR(persson_area(1, 1, share, 19).capped, 0, 1e-12);
  }
  const PerssonArea light = persson_area(1, .1, .01, .1), heavy = persson_area(1, .1, .02, .1);
  EXPECT_NEAR(light.elastic, .114584, 6e-7);
  EXPECT_NEAR(light.capped, .044054, 6e-7);
  EXPECT_NEAR(heavy.elastic, .217947, 6e-7);
  EXPECT_NEAR(heavy.capped, .093204, 6e-7);
  EXPECT_THROW(persson_area(1, .1, .1, .1), Error);
}

TEST(Exact, BoxParaboloidOfTheTables) {
  const BoxParaboloid contact = box_paraboloid_under_load(1, 1, 1e-3);
  EXPECT_NEAR(contact.approach, .0178412, 6e-8);
  EXPECT_NEAR(contact.area, .1120998, 6e-8);
  EXPECT_NEAR(box_paraboloid_at_approach(1, 1, contact.approach).load, 1e-3, 1e-17);
}

TEST(Exact, FarScalesKeepTheirDigits) {
  const double unit = hertz_under_load(1, 1, 1).approach;
  EXPECT_NEAR(hertz_under_load(1e-120, 1e120, 1e-120).approach / (unit * 1e-120), 1, 1e-14);
  EXPECT_THROW(hertz_under_load(1e-200, 1, 1e-300), Error);
  EXPECT_THROW(box_paraboloid_under_load(1e300, 1e300, 1e-300), Error);
  EXPECT_THROW(one_wave(1e-200, 1e200, 1, 1), Error);
}

// Digits of a sum in 140 decimals. One row of the file (D = 2.99, node 75, 75) has a misprinted digit and is
// left out here; beside the generator's tests it is written out.
TEST(Exact, GoldenHeightsToTheLastDigit) {
  std::ifstream file(std::string(ASPERITY_TEST_DATA) + "/wm_heights.csv");
  ASSERT_TRUE(file);
  int rows = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#' || line[0] == 'D') continue;
    std::istringstream cells(line);
    double D = 0, span = 0, height = 0;
    int i = 0, j = 0;
    char comma = 0;
    cells >> D >> comma >> span >> comma >> i >> comma >> j >> comma >> height;
    ASSERT_TRUE(cells) << line;
    if (D == 2.99 && i == 75 && j == 75) continue;
    WeierstrassMandelbrotOptions options;
    options.nx = options.ny = 150;
    options.D = D;
    options.span = span;
    options.phases = WavePhases::golden;
    const double found = weierstrass_mandelbrot_height(options, i, j);
    // The table is for D as written; a double holds some of these dimensions only to 4e-16.
    if (D * 4 == std::floor(D * 4))
      EXPECT_EQ(found, height) << line;
    else
      EXPECT_NEAR(found, height, 5e-13) << line;  // measured 1.3e-13
    ++rows;
  }
  EXPECT_GE(rows, 50);
}

}  // namespace
}  // namespace asperity::exact::exact_test
