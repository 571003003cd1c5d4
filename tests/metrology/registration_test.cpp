// SPDX-License-Identifier: GPL-3.0-or-later
// ASPERITY_WHOLE=1 runs as many problems as docs/maps.md reports and prints percentiles.
#include "engine/metrology/registration/registration.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <set>
#include <string>

#include "engine/core/parallel.hpp"
#include "engine/core/sanitizers.hpp"
#include "engine/surface/io/read.hpp"
#include "engine/surface/io/write.hpp"
#include "engine/surface/operations/placement.hpp"
#include "tests/metrology/test_fields.hpp"
#include "tests/metrology/worn_pairs.hpp"
#include "tests/support/refusal.hpp"
#include "tests/surface/files.hpp"

namespace asperity::registration_test {
namespace {

using namespace testing;

constexpr double cell = 1e-6;
constexpr double degree = pi / 180;

RegistrationOptions turns_up_to(double degrees) {
  RegistrationOptions options;
  options.angle = degrees * degree;
  return options;
}

WornPairKind clean(int nx, int ny) {
  WornPairKind kind;
  kind.name = "clean";
  kind.nx = nx;
  kind.ny = ny;
  kind.waves = 150;
  kind.most_worn = kind.most_holes = kind.least_noise = kind.most_noise = 0;
  return kind;
}
Surface ground(int nx, int ny, std::uint64_t seed = 1) {
  const WornPairKind kind = clean(nx, ny);
  return Surface(make_grid(nx, ny, nx * cell, ny * cell), WaveSurface(kind, seed).sampled(0, 0, 0));
}

Surface with_noise(const Surface& surface, double size, std::uint64_t seed) {
  Field z = surface.measured_heights();
  add_noise(z, size, seed, "noise");
  return Surface::with_holes(surface.grid(), std::move(z));
}

using test::refusal;
std::string refusal(const Surface& after, const Surface& before, const RegistrationOptions& options = {}) {
  return refusal([&] { registered(after, before, options); });
}

double greatest_difference(const Surface& a, const Surface& b) {
  double greatest = 0;
  for (std::size_t k = 0; k < a.measured_heights().size(); ++k) {
    const double difference = std::abs(a.measured_heights()[k] - b.measured_heights()[k]);
    if (difference > greatest) greatest = difference;
  }
  return greatest;
}

TEST(Registration, LaysAMapOnItself) {
  const Surface map = ground(96, 80);
  const Registration r = registered(map, map, turns_up_to(5));
  EXPECT_NEAR(r.shift_x, 0, 1e-9 * cell);
  EXPECT_NEAR(r.shift_y, 0, 1e-9 * cell);
  EXPECT_NEAR(r.angle, 0, 1e-10);
  EXPECT_EQ(r.overlap, 1);
  EXPECT_EQ(r.scale, 1);
  EXPECT_EQ(r.surface.grid(), map.grid());
  EXPECT_LT(greatest_difference(r.surface, map), 1e-14);
}

TEST(Registration, APartOfAMapLiesWhereItWasCut) {
  const Surface map = ground(128, 120);
  const Surface part = cropped(map, 17, 9, 90, 100);
  const Registration r = registered(part, map, turns_up_to(5));
  EXPECT_NEAR(r.shift_x, 17 * cell, 1e-6 * cell);
  EXPECT_NEAR(r.shift_y, 9 * cell, 1e-6 * cell);
  EXPECT_NEAR(r.angle, 0, 1e-7);
  EXPECT_EQ(r.surface.measured(), 90U * 100U);
  EXPECT_NEAR(r.overlap, 90.0 * 100 / (128 * 120), 1e-12);
  EXPECT_TRUE(std::isnan(r.surface.height(16, 50)));
  EXPECT_LT(greatest_difference(r.surface, map), 1e-12);
  // `at_most` limits the shift, not the distance of the centres.
  RegistrationOptions near = turns_up_to(5);
  near.at_most = 21 * cell;
  EXPECT_NEAR(registered(part, map, near).shift_x, 17 * cell, 1e-6 * cell);
  near.at_most = 12 * cell;
  EXPECT_NE(refusal(part, map, near), "accepted");
}

TEST(Registration, WhatWasTurnedCounterClockwiseIsTurnedBack) {
  const Surface map = ground(120, 96);
  const Surface turned = rotated(map, 0.5 * pi);
  const Registration r = registered(turned, map);
  EXPECT_NEAR(r.angle, -0.5 * pi, 1e-8);
  // The centre of 96 x 120 nodes maps to the centre of 120 x 96.
  EXPECT_NEAR(r.shift_x, 12 * cell, 1e-6 * cell);
  EXPECT_NEAR(r.shift_y, -12 * cell, 1e-6 * cell);
  EXPECT_EQ(r.overlap, 1);
  EXPECT_LT(greatest_difference(r.surface, map), 1e-12);
}

TEST(Registration, TiltAndLiftAreThoseOfTheMapAfter) {
  const WornPairKind kind = clean(128, 128);
  const WaveSurface waves(kind, 3);
  const double angle = 30 * degree;
  const Grid grid = make_grid(128, 128, 128 * cell, 128 * cell);
  Field z = waves.sampled(5 * cell, -3 * cell, angle);
  // A later slope of 0.02 along x is (0.02 cos 30°, 0.02 sin 30°) before.
  const double middle = 63.5 * cell;
  for (int j = 0; j < 128; ++j)
    for (int i = 0; i < 128; ++i) z(i, j) += 7e-6 + 0.02 * (i * cell - middle);
  const Surface before(grid, waves.sampled(0, 0, 0)), after(grid, std::move(z));
  const Registration r = registered(after, before);
  EXPECT_NEAR(r.shift_x, 5 * cell, 1e-3 * cell);
  EXPECT_NEAR(r.shift_y, -3 * cell, 1e-3 * cell);
  EXPECT_NEAR(r.angle, angle, 1e-5);
  EXPECT_NEAR(r.tilt_x, 0.02 * std::cos(angle), 1e-5);
  EXPECT_NEAR(r.tilt_y, 0.02 * std::sin(angle), 1e-5);
  EXPECT_NEAR(r.lift, 7e-6, 1e-10);
  EXPECT_LT(greatest_difference(r.surface, before), 0.05e-6);
}

TEST(Registration, CellsAndSizesMayDiffer) {
  WornPairKind kind = clean(150, 110);
  const Surface before(make_grid(150, 110, 150 * cell, 110 * cell), WaveSurface(kind, 4).sampled(0, 0, 0));
  // Cells of 0.8 x 1.25 µm, common first node.
  WornPairKind other = kind;
  other.nx = 120;
  other.ny = 80;
  other.cell_x = 0.8 * cell;
  other.cell_y = 1.25 * cell;
  const double turn = 2 * degree;
  const Surface after(make_grid(120, 80, 96 * cell, 100 * cell),
                      WaveSurface(other, 4).sampled(9 * cell, 4 * cell, turn));
  const Registration r = registered(after, before, turns_up_to(5));
  EXPECT_NEAR(r.shift_x, 9 * cell, 2e-3 * cell);
  EXPECT_NEAR(r.shift_y, 4 * cell, 2e-3 * cell);
  EXPECT_NEAR(r.angle, turn, 1e-4);
  EXPECT_EQ(r.surface.grid(), before.grid());
}

TEST(Registration, ASmallPatchAndANarrowBandAreFound) {
  const Surface map = ground(512, 300);
  const Registration patch = registered(cropped(map, 301, 77, 64, 64), map, turns_up_to(3));
  EXPECT_NEAR(patch.shift_x, 301 * cell, 1e-4 * cell);
  EXPECT_NEAR(patch.shift_y, 77 * cell, 1e-4 * cell);
  const Registration band =
      registered(cropped(map, 3, 2, 505, 33), cropped(map, 0, 0, 512, 40), turns_up_to(3));
  EXPECT_NEAR(band.shift_x, 3 * cell, 1e-4 * cell);
  EXPECT_NEAR(band.shift_y, 2 * cell, 1e-4 * cell);
}

TEST(Registration, HolesOfTheMapAfterStayHoles) {
  const Surface map = ground(96, 96);
  Field z = map.heights();
  for (int j = 40; j < 50; ++j)
    for (int i = 30; i < 45; ++i) z(i, j) = std::numeric_limits<double>::quiet_NaN();
  const Surface after = Surface::with_holes(map.grid(), std::move(z));
  const Registration r = registered(after, map, turns_up_to(1));
  EXPECT_EQ(r.surface.measured(), 96U * 96 - 150);
  EXPECT_TRUE(std::isnan(r.surface.height(30, 40)));
  EXPECT_FALSE(std::isnan(r.surface.height(29, 40)));
  EXPECT_LT(greatest_difference(r.surface, map), 1e-12);
  EXPECT_TRUE(registered(map, after, turns_up_to(1)).surface.complete());
}

TEST(Registration, SinglePointsMissingAndSpikesDoNotMoveIt) {
  WornPairKind kind;
  kind.name = "spikes";
  kind.nx = kind.ny = 128;
  kind.waves = 150;
  const WornPair pair = worn_pair(kind, 1);
  const Stream draw(1, "spikes");
  const auto spoilt = [&](const Surface& map, std::uint64_t first, double height) {
    Field z = map.measured_heights();
    for (std::size_t k = 0; k < z.size(); ++k) {
      if (draw.uniform(first + 2 * k) < 0.03) z[k] = std::numeric_limits<double>::quiet_NaN();
      if (draw.uniform(first + 2 * k + 1) < 0.01) z[k] = height;
    }
    return Surface::with_holes(map.grid(), std::move(z));
  };
  const Registration r =
      registered(spoilt(pair.after, 0, 20e-6), spoilt(pair.before, 1 << 20, -20e-6), turns_up_to(6));
  EXPECT_NEAR(r.shift_x, pair.shift_x, 0.05 * cell);
  EXPECT_NEAR(r.shift_y, pair.shift_y, 0.05 * cell);
  EXPECT_NEAR(r.angle, pair.angle, 0.05 * degree);
}

struct Errors {
  std::vector<double> shift, angle;  // cells, degrees
  double mean_x = 0, mean_y = 0;     // cells
  int lost = 0, within_2u = 0, values = 0;

  static double percentile(std::vector<double> of, double p) {
    std::sort(of.begin(), of.end());
    return of[std::min(of.size() - 1, static_cast<std::size_t>(p * static_cast<double>(of.size())))];
  }
  double share(double cells, double degrees) const {
    double count = 0;
    for (std::size_t k = 0; k < shift.size(); ++k) count += shift[k] <= cells && angle[k] <= degrees ? 1 : 0;
    return count / static_cast<double>(shift.size());
  }
  double honest() const { return static_cast<double>(within_2u) / values; }
};

bool whole() {
  const char* given = std::getenv("ASPERITY_WHOLE");
  return given != nullptr && *given != '\0' && *given != '0';
}

template <class Pair>
Errors errors_of(const WornPairKind& kind, int all, int few, const RegistrationOptions& options,
                 const Pair& pair_of) {
  Errors errors;
  const int count = whole() ? all : few;
  for (int k = 1; k <= count; ++k) {
    const WornPair pair = pair_of(static_cast<std::uint64_t>(k));
    const Registration r = registered(pair.after, pair.before, options);
    const double x = r.shift_x - pair.shift_x, y = r.shift_y - pair.shift_y;
    const double turn = std::remainder(r.angle - pair.angle, two_pi);
    errors.shift.push_back(std::hypot(x / kind.cell_x, y / kind.cell_y));
    errors.angle.push_back(std::abs(turn) / degree);
    errors.mean_x += x / kind.cell_x / count;
    errors.mean_y += y / kind.cell_y / count;
    errors.lost += errors.shift.back() > 1 ? 1 : 0;
    for (const auto& [error, u] :
         {std::pair{x, r.u.shift_x}, std::pair{y, r.u.shift_y}, std::pair{turn, r.u.angle}}) {
      errors.within_2u += std::abs(error) < 2 * u ? 1 : 0;
      errors.values += 1;
    }
  }
  if (whole()) {
    const auto at = [](const std::vector<double>& of, double p) { return Errors::percentile(of, p); };
    std::printf("%s, %d: %.4f / %.4f / %.4f / %.4f cells, %.4f / %.4f / %.4f / %.4f deg, %.2f within 2u\n",
                kind.name.c_str(), count, at(errors.shift, 0.5), at(errors.shift, 0.9),
                at(errors.shift, 0.95), at(errors.shift, 1), at(errors.angle, 0.5), at(errors.angle, 0.9),
                at(errors.angle, 0.95), at(errors.angle, 1), errors.honest());
  }
  return errors;
}
Errors errors_of(const WornPairKind& kind, int all, int few, const RegistrationOptions& options) {
  return errors_of(kind, all, few, options, [&](std::uint64_t k) { return worn_pair(kind, k); });
}
WornPairKind named(const char* name) {
  WornPairKind kind;
  kind.name = name;
  return kind;
}

// The tests of Registration cover the same memory under sanitizers.
class RegistrationAccuracy : public ::testing::Test {
 protected:
  void SetUp() override {
    if (sanitized) GTEST_SKIP() << "accuracy is measured without sanitizers";
  }
};

TEST_F(RegistrationAccuracy, WornPairsWithinAHundredthOfACell) {
  const Errors e = errors_of(named("small"), 100, 3, turns_up_to(6));
  EXPECT_EQ(e.lost, 0);
  EXPECT_GE(e.share(0.02, 0.01), 0.95);
  EXPECT_LT(Errors::percentile(e.shift, 0.5), 0.006);
  EXPECT_LT(Errors::percentile(e.angle, 0.5), 0.002);
  EXPECT_GE(e.honest(), 0.8);
}

TEST_F(RegistrationAccuracy, AnyAngle) {
  WornPairKind kind = named("any");
  kind.turn = pi;
  const Errors e = errors_of(kind, 25, 1, RegistrationOptions{});
  EXPECT_EQ(e.lost, 0);
  EXPECT_GE(e.share(0.02, 0.01), 0.9);
  EXPECT_GE(e.honest(), 0.65);
}

TEST_F(RegistrationAccuracy, HalfOfTheGroundWorn) {
  WornPairKind kind = named("worn");
  kind.least_worn = 0.3;
  kind.most_worn = 0.5;
  const Errors e = errors_of(kind, 20, 1, turns_up_to(6));
  EXPECT_EQ(e.lost, 0);
  EXPECT_GE(e.share(0.02, 0.01), 0.9);
}

TEST_F(RegistrationAccuracy, AlongALay) {
  WornPairKind kind = named("lay");
  kind.lay = 10;
  const Errors e = errors_of(kind, 25, 1, turns_up_to(6));
  EXPECT_EQ(e.lost, 0);
  EXPECT_GE(e.share(0.1, 0.015), 0.9);
}

// Interpolating only one of two noisy maps biases the shift by half a cell.
TEST_F(RegistrationAccuracy, NoiseDoesNotDrawItToHalfACell) {
  WornPairKind kind = named("half");
  kind.least_noise = kind.most_noise = 0.05;
  const Errors e = errors_of(kind, 30, 3, turns_up_to(6),
                             [&](std::uint64_t k) { return worn_pair(kind, k, 0.3 * cell, 0.25 * cell, 0); });
  EXPECT_LT(std::hypot(e.mean_x, e.mean_y), 0.01);
}

// Smoothing lowers nodes next to worn ones by less than the noise: they count as unworn, the zero of wear.
TEST_F(RegistrationAccuracy, LiftIsThatOfGroundThatIsNotWorn) {
  WornPairKind kind = named("lift");
  kind.nx = kind.ny = 160;
  kind.least_worn = kind.most_worn = 0.2;
  kind.least_noise = kind.most_noise = 0.01;
  const int count = whole() ? 40 : 6;
  double mean = 0, mean_u = 0;
  int within_2u = 0;
  for (int k = 1; k <= count; ++k) {
    const WornPair pair = worn_pair(kind, static_cast<std::uint64_t>(k));
    const Registration r = registered(pair.after, pair.before, turns_up_to(6));
    mean += (r.lift - pair.lift) / count;
    mean_u += r.u.lift / count;
    within_2u += std::abs(r.lift - pair.lift) < 2 * r.u.lift ? 1 : 0;
  }
  if (whole())
    std::printf("lift: %.3f nm too high, u %.3f nm, %d of %d within 2u\n", mean * 1e9, mean_u * 1e9,
                within_2u, count);
  EXPECT_LT(std::abs(mean), 0.02 * kind.most_noise * kind.rms);
  EXPECT_GE(within_2u, 0.8 * count);
}

TEST_F(RegistrationAccuracy, LongCellsAndSizesThatAreNoPowersOfTwo) {
  WornPairKind kind = named("long");
  kind.nx = 200;
  kind.ny = 123;
  kind.cell_y = 2e-6;
  kind.shift = 10;
  const Errors e = errors_of(kind, 20, 1, turns_up_to(6));
  EXPECT_EQ(e.lost, 0);
  EXPECT_GE(e.share(0.03, 0.02), 0.9);
}

TEST(Registration, SameBitsForAnyNumberOfThreads) {
  WornPairKind kind = named("threads");
  kind.nx = 110;
  kind.ny = 97;
  kind.waves = 100;
  const WornPair pair = worn_pair(kind, 2);
  const int threads = thread_count();
  set_thread_count(1);
  const Registration one = registered(pair.after, pair.before, turns_up_to(6));
  set_thread_count(3);
  const Registration three = registered(pair.after, pair.before, turns_up_to(6));
  set_thread_count(threads);
  EXPECT_EQ(one.surface.digest(), three.surface.digest());
  EXPECT_EQ(one.shift_x, three.shift_x);
  EXPECT_EQ(one.angle, three.angle);
  EXPECT_EQ(one.u.shift_y, three.u.shift_y);
  EXPECT_EQ(one.residual, three.residual);
}

class Listening : public Monitor {
 public:
  void progress(std::string_view what, double) override {
    heard.insert(std::string(what));
    if (stop) stop_flag().raise(StopReason::interrupt);
  }
  void warn(std::string_view) override {}
  std::set<std::string> heard;
  bool stop = false;
};

TEST(Registration, ReportsProgressAndStops) {
  const Surface map = ground(256, 256);
  Listening monitor;
  monitor.stop = true;
  try {
    registered(map, map, {}, monitor);
    ADD_FAILURE() << "did not stop";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::interrupted);
  }
  stop_flag().clear();
  EXPECT_TRUE(monitor.heard.contains("looking for the place of the map"));
}

TEST(Registration, RefusesUnrelatedGround) {
  const std::string said = refusal(ground(128, 128, 1), ground(128, 128, 2), turns_up_to(5));
  EXPECT_EQ(said.substr(0, 28), "the best placement explains ") << said;
  EXPECT_NE(said.find("the maps show different places"), std::string::npos) << said;
}

TEST(Registration, RefusesGroundThatRepeats) {
  const auto box = [](double x, double y) {
    return 1e-6 * (std::sin(two_pi * x / 16) + std::sin(two_pi * y / 16));
  };
  const auto map = [&](double shift) {
    return make_surface(128, 128, 128 * cell, 128 * cell, [&](int i, int j) { return box(i + shift, j); });
  };
  const Surface after = with_noise(map(3), 1e-8, 1), before = with_noise(map(0), 1e-8, 2);
  EXPECT_NE(refusal(after, before, turns_up_to(5)).find("the surface repeats itself"), std::string::npos);
  RegistrationOptions near = turns_up_to(5);
  near.at_most = 5 * cell;
  EXPECT_NEAR(registered(after, before, near).shift_x, 3 * cell, 0.01 * cell);
}

TEST(Registration, RefusesRidgesWithoutEnd) {
  const Surface ridges = make_surface(128, 128, 128 * cell, 128 * cell, [](int i, int) {
    return 1e-6 * (std::sin(two_pi * i / 20) + std::sin(two_pi * i / 31.7) + std::sin(two_pi * i / 7.3));
  });
  for (const double noise : {0.0, 1e-8}) {
    const std::string said =
        refusal(with_noise(ridges, noise, 1), with_noise(ridges, noise, 2), turns_up_to(5));
    EXPECT_NE(said.find("the surface has no features along one direction"), std::string::npos) << said;
  }
}

TEST(Registration, RefusesASphereThatMayBeTurned) {
  const Surface sphere = make_surface(128, 128, 128 * cell, 128 * cell, [](int i, int j) {
    return -1e-10 * ((i - 50.0) * (i - 50.0) + (j - 60.0) * (j - 60.0));
  });
  for (const double noise : {0.0, 1e-10, 1e-9}) {
    const std::string said =
        refusal(with_noise(sphere, noise, 1), with_noise(sphere, noise, 2), turns_up_to(5));
    EXPECT_NE(said.find("looks the same when it is turned"), std::string::npos) << said;
  }
}

TEST(Registration, RefusesFlatMapsAndSmallOnes) {
  const Surface plane =
      make_surface(64, 64, 64 * cell, 64 * cell, [](int i, int j) { return 1e-6 * (3 * i - j); });
  const Surface map = ground(64, 64);
  EXPECT_EQ(
      refusal(plane, map),
      "the after-map is flat except for its tilt, so it has no definite place; register a rough surface");
  EXPECT_EQ(
      refusal(map, plane),
      "the before-map is flat except for its tilt, so it has no definite place; register a rough surface");
  EXPECT_EQ(refusal(cropped(map, 0, 0, 31, 64), map),
            "the after-map has 31 x 64 cells; fewer than 32 along a side cannot be registered; measure on "
            "more cells");
}

TEST(Registration, RefusesMapsOfLittleInCommon) {
  const Surface map = ground(128, 128);
  EXPECT_NE(refusal(cropped(map, 0, 0, 64, 128), cropped(map, 60, 0, 68, 128), turns_up_to(5)), "accepted");
  const Surface coarse(make_grid(64, 64, 64e-3, 64e-3), Field(ground(64, 64).heights()));
  EXPECT_EQ(
      refusal(map, coarse),
      "the maps have too little in common: one is 128 um x 128 um and the other 64 mm x 64 mm; crop the "
      "larger one, or measure both with like cells");
}

TEST(Registration, RefusesFewLongCellsAsWhatTheyAre) {
  const Surface map(make_grid(64, 32, 64e-6, 96e-6), Field(ground(64, 32).heights()));
  EXPECT_EQ(refusal(map, map),
            "the search moves the maps in steps of 6 um, twice their longest cell, and 11 steps along a side "
            "are fewer than 16; give the maps square cells with `resampled`, or measure on more cells");
}

TEST(Registration, OptionsOutOfRange) {
  const Surface map = ground(64, 64);
  RegistrationOptions options = turns_up_to(-1);
  EXPECT_EQ(refusal(map, map, options).substr(0, 14), "`angle` is -0.");
  options = turns_up_to(1);
  options.at_most = 0;
  EXPECT_EQ(refusal(map, map, options), "`at_most` is 0 m; give the greatest shift, above zero");
}

// Formats store lines from the top or the bottom.
TEST(Registration, OneScanInTwoFormatsNeedsNoTurn) {
  const testing::Scratch scratch;
  Surface scan = ground(80, 64);
  Field z = scan.measured_heights();
  for (int i = 0; i < 9; ++i) z(20 + i, 50) = std::numeric_limits<double>::quiet_NaN();
  scan = Surface::with_holes(scan.grid(), std::move(z));
  const auto through = [&](const std::string& ending) {
    write_surface(scan, scratch.path("scan." + ending));
    return read_surface(scratch.path("scan." + ending));
  };
  const Surface before = through("x3p");
  for (const char* ending : {"gwy", "sur"}) {
    const Registration found = registered(through(ending), before);
    EXPECT_NEAR(found.angle, 0, 1e-7) << ending;
    EXPECT_NEAR(found.shift_x, 0, 1e-5 * cell) << ending;
    EXPECT_NEAR(found.shift_y, 0, 1e-5 * cell) << ending;
    EXPECT_NEAR(found.residual, 0, 1e-6 * scan.peak_to_valley()) << ending;  // SUR rounds heights and sizes
    EXPECT_EQ(found.overlap, 1) << ending;
  }
}

}  // namespace
}  // namespace asperity::registration_test
