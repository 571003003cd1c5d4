// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/generators/bead_blasted.hpp"
#include "engine/core/constants.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::bead_blasted_test {
namespace {

BeadBlastedOptions example(int nx = 128, int ny = 128) {
  BeadBlastedOptions options;
  options.grid = Grid{nx, ny, 500e-6, 500e-6};
  options.ra = 3e-6;
  return options;
}

BeadBlastedOptions one_dent(int nx = 400, int ny = 400) {
  BeadBlastedOptions options = example(nx, ny);
  options.bead_low = options.bead_high = 250e-6;
  options.dent_low = options.dent_high = 40e-6;
  options.coverage = 1e-3;
  options.fine.reset();
  return options;
}

double mean_magnitude(const Surface& s) {
  double sum = 0;
  for (const double z : s.heights().values()) sum += std::abs(z);
  return sum / static_cast<double>(s.heights().size());
}

template <class Change>
std::string refusal(const Change& change) {
  BeadBlastedOptions options = example(25, 25);
  change(options);
  return test::refusal([&] { bead_blasted_surface(options); });
}

TEST(BeadBlasted, RaIsMetExactlyAndTheMeanIsZero) {
  for (const auto& [nx, ny] : {std::pair{128, 128}, {97, 101}, {64, 120}})
    for (const bool fine : {true, false}) {
      BeadBlastedOptions options = example(nx, ny);
      if (!fine) options.fine.reset();
      const Surface s = bead_blasted_surface(options);
      EXPECT_NEAR(mean_magnitude(s), 3e-6, 3e-6 * 1e-13) << nx << " x " << ny;
      EXPECT_LT(std::abs(mean(s.heights().values())), 3e-6 * 1e-13);
      EXPECT_TRUE(s.traits().periodic);
      EXPECT_FALSE(s.traits().aliased_share);
    }
}

TEST(BeadBlasted, DentsCoverTheTileAsOftenAsAsked) {
  BeadBlastedOptions options = example();
  EXPECT_EQ(dent_count(options), std::round(4 * 500.0 * 500 / (pi * 42.5 * 42.5)));
  options.coverage = 8;
  EXPECT_EQ(dent_count(options), std::round(8 * 500.0 * 500 / (pi * 42.5 * 42.5)));
  options.coverage = 1e-6;
  EXPECT_EQ(dent_count(options), 1);
}

TEST(BeadBlasted, ADentIsAParaboloidOnTheGroundWithHalfItsVolumeAroundIt) {
  const BeadBlastedOptions options = one_dent();
  const Surface s = bead_blasted_surface(options);
  const Field& z = s.heights();
  // The deepest node is the dent's centre; the surroundings have height `ground`.
  std::size_t deepest = 0;
  for (std::size_t k = 0; k < z.size(); ++k)
    if (z[k] < z[deepest]) deepest = k;
  const int ci = static_cast<int>(deepest % 400), cj = static_cast<int>(deepest / 400);
  const double h = 1.25e-6;
  const auto at = [&](double x, double y) {  // m from the deepest node
    const int i = ci + static_cast<int>(std::lround(x / h)), j = cj + static_cast<int>(std::lround(y / h));
    return z(((i % 400) + 400) % 400, ((j % 400) + 400) % 400);
  };
  const double ground = at(200e-6, 0);
  EXPECT_NEAR(at(0, 200e-6), ground, 1e-6 * (ground - z[deepest]));
  // Depth a²/2R; the rim's height at the centre is 4e-15 of its crest.
  const double depth = 40e-6 * 40e-6 / (2 * 125e-6);
  const double scale = (ground - z[deepest]) / depth;
  // c · ∫ rim = half of the paraboloid's volume, π a⁴/8R.
  const double a = 40e-6, width = 0.2 * a, radius = 1.15 * a;
  const double rim_area = 2 * pi * radius * width * std::sqrt(pi);
  const double crest = 0.5 * pi * std::pow(a, 4) / (8 * 125e-6) * 2 / rim_area;
  for (const double r : {5e-6, 10e-6, 20e-6, 30e-6, 40e-6, 46.25e-6, 52.5e-6, 60e-6, 75e-6}) {
    const double floor = std::min(0.0, (r * r - a * a) / (2 * 125e-6));
    const double rim = crest * std::exp(-std::pow((r - radius) / width, 2));
    // The centre is within half a cell of the deepest node (0.9 µm); slopes reach 0.4.
    EXPECT_NEAR((at(r, 0) + at(-r, 0) + at(0, r) + at(0, -r)) / 4 - ground, scale * (floor + rim),
                0.02 * scale * depth)
        << r;
  }
  double below = 0, above = 0;
  for (const double height : z.values()) (height < ground ? below : above) += height - ground;
  EXPECT_LT(above, -below);
  EXPECT_GT(above, -0.25 * below);
}

TEST(BeadBlasted, DentsWrapRoundTheTile) {
  // A wrapped dent has the same variance at any position.
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    BeadBlastedOptions options = one_dent(200, 200);
    options.seed = seed;
    const Surface s = bead_blasted_surface(options);
    least = std::min(least, s.peak_to_valley());
    most = std::max(most, s.peak_to_valley());
  }
  EXPECT_LT(most / least - 1, 0.02);
}

TEST(BeadBlasted, AFinerGridIsTheSameSurface) {
  // Common nodes differ by the sampling error of sums, which falls with the cell size.
  for (const bool fine : {true, false}) {
    BeadBlastedOptions options = example(64, 80);
    if (fine)
      options.fine = BlastTexture{};
    else
      options.fine.reset();
    const auto difference = [&](int k) {
      options.grid.nx = 64 * k;
      options.grid.ny = 80 * k;
      const Surface coarse = bead_blasted_surface(options);
      options.grid.nx *= 2;
      options.grid.ny *= 2;
      const Surface finer = bead_blasted_surface(options);
      double sum = 0;
      for (int j = 0; j < coarse.grid().ny; ++j)
        for (int i = 0; i < coarse.grid().nx; ++i)
          sum += std::pow(finer.heights()(2 * i, 2 * j) - coarse.heights()(i, j), 2);
      return std::sqrt(sum / static_cast<double>(coarse.grid().nodes())) / options.ra;
    };
    const double first = difference(1), second = difference(2), third = difference(4);
    EXPECT_LT(first, 0.05) << fine;
    EXPECT_LT(second, 0.7 * first) << fine;
    EXPECT_LT(third, 0.7 * second) << fine;
  }
}

TEST(BeadBlasted, SeedsDiffer) {
  BeadBlastedOptions options = example(64, 64);
  const Surface one = bead_blasted_surface(options);
  EXPECT_EQ(bead_blasted_surface(options).digest(), one.digest());
  options.seed = 2;
  EXPECT_NE(bead_blasted_surface(options).digest(), one.digest());
}

TEST(BeadBlasted, TheTextureIsItsShareOfRa) {
  // Final scaling: surface = c (dents + texture).
  BeadBlastedOptions options = example();
  const Surface with = bead_blasted_surface(options);
  options.fine.reset();
  const Surface without = bead_blasted_surface(options);
  // c: least-squares share of the dents, which are independent of the texture.
  double cross = 0, square = 0;
  for (std::size_t k = 0; k < with.heights().size(); ++k) {
    cross += with.heights()[k] * without.heights()[k];
    square += without.heights()[k] * without.heights()[k];
  }
  const double c = cross / square;
  double sum = 0;
  for (std::size_t k = 0; k < with.heights().size(); ++k)
    sum += std::abs(with.heights()[k] / c - without.heights()[k]);
  EXPECT_NEAR(sum / static_cast<double>(with.heights().size()) / 3e-6, 0.12, 0.006);
}

TEST(BeadBlasted, TheNumberOfDentsIsRounded) {
  BeadBlastedOptions options = one_dent(100, 100);
  const Surface one = bead_blasted_surface(options);
  options.coverage = 0.03;  // 1.49 dents
  ASSERT_EQ(dent_count(options), 1);
  EXPECT_EQ(bead_blasted_surface(options).digest(), one.digest());
}

TEST(BeadBlasted, SameBitsForAnyNumberOfThreads) {
  // Threads share the rows of a dent.
  BeadBlastedOptions options = example(1200, 1100);
  options.fine.reset();
  set_thread_count(1);
  const std::string one = bead_blasted_surface(options).digest();
  set_thread_count(3);
  EXPECT_EQ(bead_blasted_surface(options).digest(), one);
  set_thread_count(2);
}

TEST(BeadBlasted, SmallTilesAndOblongCells) {
  BeadBlastedOptions options = example(16, 40);
  options.grid.size_x = 60e-6;  // overlaps itself
  options.grid.size_y = 90e-6;
  options.fine.reset();
  const Surface s = bead_blasted_surface(options);
  EXPECT_NEAR(mean_magnitude(s), 3e-6, 3e-18);
  options = example(400, 40);  // 1.25 x 12.5 µm
  options.fine.reset();
  EXPECT_NEAR(mean_magnitude(bead_blasted_surface(options)), 3e-6, 3e-18);
}

TEST(BeadBlasted, RefusesWhatNoBeadMakes) {
  using O = BeadBlastedOptions;
  EXPECT_EQ(refusal([](O& o) { o.ra = 0; }), "`ra` is 0; give a finite value above zero");
  EXPECT_EQ(refusal([](O& o) { o.coverage = -1; }), "`coverage` is -1; give a finite value above zero");
  EXPECT_EQ(refusal([](O& o) { o.bead_low = 400e-6; }),
            "`bead` runs from 400 um down to 300 um; give the smaller length first");
  EXPECT_EQ(refusal([](O& o) { o.dent_low = std::nan(""); }),
            "`dent` is nan; give a finite value above zero");
  EXPECT_EQ(refusal([](O& o) { o.dent_high = 126e-6; }),
            "`dent` allows a radius of 126 um, and `bead` a bead of radius 125 um; give smaller radii as "
            "`dent`, or larger diameters as `bead`");
  EXPECT_EQ(refusal([](O& o) { o.grid.nx = 19; }),
            "a cell of 26.32 um is longer than the radius of the smallest dent, 25 um; give more `cells`");
  EXPECT_EQ(refusal([](O& o) { o.coverage = 1e9; }),
            "the surface would have 4.40567e+10 dents; at most 1e+07 are made; give a smaller `size` or "
            "`coverage`, "
            "or larger `dent` radii");
  EXPECT_EQ(refusal([](O& o) { o.fine->share = 1.5; }),
            "`share` of the fine texture is 1.5; give a number above 0 and at most 1");
  EXPECT_EQ(refusal([](O&) {}),
            "the fine texture: `short_wave` is 16 um, under two cells of 20 um; give at least 40 um, or more "
            "`cells`, or leave the texture out with `fine` = false");
  EXPECT_EQ(
      refusal([](O& o) { o.fine->hurst = 0; }),
      "the fine texture: `hurst` is 0; give a number above 0 and at most 1, or leave the texture out with "
      "`fine` = false");
  EXPECT_EQ(refusal([](O& o) { o.fine.reset(); }), "accepted");
}

}  // namespace
}  // namespace asperity::bead_blasted_test
