// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "engine/surface/generators/bead_blasted.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "engine/surface/generators/sine.hpp"
#include "engine/surface/generators/sphere.hpp"
#include "engine/surface/generators/weierstrass_mandelbrot.hpp"
#include "engine/surface/operations/heights.hpp"
#include "engine/surface/operations/placement.hpp"
#include "engine/surface/operations/resampling.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::at_cells_test {
namespace {

// At common nodes, relative to the peak-to-valley height.
double difference(const Surface& coarse, const Surface& fine) {
  const int step_x = fine.grid().nx / coarse.grid().nx, step_y = fine.grid().ny / coarse.grid().ny;
  double worst = 0;
  for (int j = 0; j < coarse.grid().ny; ++j)
    for (int i = 0; i < coarse.grid().nx; ++i)
      worst = std::max(worst, std::abs(coarse.heights()(i, j) - fine.heights()(step_x * i, step_y * j)));
  return worst / std::max(fine.peak_to_valley(), 1e-300);
}

SelfAffineOptions self_affine(int n) {
  SelfAffineOptions o = test::self_affine(Grid{n, n, 1e-3, 1e-3}, 0.8, 1e-3 / 16, 4);
  o.ra = 1e-6;
  return o;
}

WeierstrassMandelbrotOptions fractal(int n) {
  WeierstrassMandelbrotOptions o;
  o.nx = o.ny = n;
  o.D = 2.4;
  o.L = 1e-3;
  o.G = 1e-8;
  o.seed = 3;
  return o;
}

void expect_same(const Surface& surface, double within) {
  const Grid& g = surface.grid();
  for (const int factor : {2, 3}) {
    const AtCells finer = at_cells(surface, factor * g.nx, factor * g.ny);
    EXPECT_EQ(finer.how, AtCells::How::made_again);
    EXPECT_LE(difference(surface, finer.surface), within) << factor;
    EXPECT_EQ(finer.surface.grid().size_x, g.size_x);
    EXPECT_EQ(finer.surface.traits().periodic, surface.traits().periodic);
    EXPECT_NE(finer.surface.recipe(), nullptr);
  }
}

TEST(AtCells, GeneratorsMakeTheSameSurfaceAgain) {
  constexpr double rounding = 1e-12;
  expect_same(self_affine_surface(self_affine(48)), rounding);
  expect_same(weierstrass_mandelbrot(fractal(48)), rounding);
  expect_same(sine_surface({Grid{32, 16, 2e-3, 1e-3}, 1e-6, 0.5e-3, 2}), rounding);
  expect_same(sphere_surface({Grid{32, 32, 1e-3, 1e-3}, 10e-3, SphereShape::sphere}), rounding);
  expect_same(sphere_surface({Grid{33, 31, 1e-3, 1e-3}, 10e-3, SphereShape::paraboloid}), rounding);
  const Surface flat = flat_surface({Grid{8, 8, 1, 1}});
  EXPECT_EQ(at_cells(flat, 12, 24).how, AtCells::How::made_again);
  EXPECT_EQ(at_cells(flat, 12, 24).surface.peak_to_valley(), 0);
}

TEST(AtCells, ResolvedFractalKeepsItsWaves) {
  WeierstrassMandelbrotOptions o = fractal(40);
  o.band = WaveBand::resolved;
  const Surface surface = weierstrass_mandelbrot(o);
  expect_same(surface, 1e-12);
  // A generator on 80 cells would add waves.
  o.nx = o.ny = 80;
  EXPECT_GT(difference(surface, weierstrass_mandelbrot(o)), 1e-3);
  EXPECT_EQ(at_cells(surface, 80, 80).surface.traits().aliased_share, 0.0);
}

TEST(AtCells, PhasesOfAFunctionAreRemembered) {
  WeierstrassMandelbrotOptions o = fractal(24);
  o.n_max = 8;
  o.phases = WavePhases::function;
  int calls = 0;
  o.phase_function = [&calls](int m, int n) {
    ++calls;
    return 0.1 * m + 0.7 * n;
  };
  const Surface surface = weierstrass_mandelbrot(o);
  const int first = calls;
  EXPECT_EQ(first, o.M * (o.n_max + 1));
  expect_same(surface, 1e-12);
  EXPECT_EQ(calls, first);
}

TEST(AtCells, CellsOfAFractalStaySquare) {
  WeierstrassMandelbrotOptions o = fractal(24);
  o.ny = 12;
  const Surface surface = weierstrass_mandelbrot(o);
  EXPECT_EQ(at_cells(surface, 48, 24).how, AtCells::How::made_again);
  EXPECT_EQ(at_cells(surface, 48, 48).how, AtCells::How::interpolated);
}

TEST(AtCells, BlastedSurfaceIsTheSameUpToItsSums) {
  BeadBlastedOptions o;
  o.grid = Grid{128, 128, 0.5e-3, 0.5e-3};
  o.ra = 2e-6;
  o.seed = 2;
  o.fine = BlastTexture{};
  const Surface surface = bead_blasted_surface(o);
  const AtCells finer = at_cells(surface, 256, 256);
  EXPECT_EQ(finer.how, AtCells::How::made_again);
  // Measured: half of the nodes within 0.5 % of Ra, nine in ten within 1.3 %, all within 4 %.
  std::vector<double> off;
  for (int j = 0; j < 128; ++j)
    for (int i = 0; i < 128; ++i)
      off.push_back(std::abs(surface.heights()(i, j) - finer.surface.heights()(2 * i, 2 * j)) / o.ra);
  std::sort(off.begin(), off.end());
  EXPECT_LT(off[off.size() / 2], 0.01);
  EXPECT_LT(off[off.size() * 9 / 10], 0.03);
}

TEST(AtCells, SelfAffineOfTooFewCellsIsSampledInstead) {
  const Surface surface = self_affine_surface(self_affine(96));
  const AtCells coarse = at_cells(surface, 24, 24);  // under two per wave
  EXPECT_EQ(coarse.how, AtCells::How::sampled);
  EXPECT_EQ(difference(coarse.surface, surface), 0);
  EXPECT_NE(coarse.surface.recipe(), nullptr);
  EXPECT_FALSE(coarse.surface.traits().aliased_share.has_value());
  EXPECT_EQ(at_cells(surface, 20, 20).how, AtCells::How::interpolated);
  EXPECT_EQ(at_cells(surface, 40, 40).how, AtCells::How::made_again);
}

TEST(AtCells, OperationsThatKnowHowCarryTheRecipeOn) {
  const Surface surface = self_affine_surface(self_affine(48));
  Material steel;
  steel.name = "steel";
  const Surface made = surface.with_material(steel);
  expect_same(made, 1e-12);
  EXPECT_EQ(at_cells(made, 96, 96).surface.material()->name, "steel");
  expect_same(scaled(made, ScaleTo::amplitude, 7e-6), 1e-12);
  expect_same(cut(made, 0.3), 1e-12);
  expect_same(plus(made, sine_surface({made.grid(), 1e-6, {}, 1})), 1e-12);
  expect_same(shifted(made, 5 * made.grid().hx(), -2 * made.grid().hy()), 1e-12);
  EXPECT_EQ(at_cells(scaled(made, ScaleTo::ra, 1e-6), 96, 96).surface.material()->name, "steel");
  EXPECT_EQ(mirrored(made).recipe(), nullptr);
  EXPECT_EQ(cropped(made, 0, 0, 24, 24).recipe(), nullptr);
  EXPECT_EQ(resampled(made, 96, 96).recipe(), nullptr);
}

TEST(AtCells, RecipeIsNoPartOfWhatASurfaceIs) {
  const Surface surface = self_affine_surface(self_affine(32));
  const Surface bare(surface.grid(), surface.heights(), surface.traits());
  EXPECT_EQ(bare.digest(), surface.digest());
  EXPECT_EQ(bare.recipe(), nullptr);
}

TEST(AtCells, MeasuredHeightsAreSampledAndInterpolated) {
  const Stream stream(1, "at_cells test");
  Field z(12, 10);
  for (std::size_t k = 0; k < z.size(); ++k) z[k] = stream.normal(k);
  const Surface measured(Grid{12, 10, 1, 1}, z, {.material = {}, .periodic = true, .aliased_share = {}});
  EXPECT_EQ(at_cells(measured, 12, 10).how, AtCells::How::unchanged);
  const AtCells half = at_cells(measured, 6, 5);
  EXPECT_EQ(half.how, AtCells::How::sampled);
  EXPECT_EQ(difference(half.surface, measured), 0);
  const AtCells twice = at_cells(measured, 24, 20);
  EXPECT_EQ(twice.how, AtCells::How::interpolated);
  EXPECT_LT(difference(measured, twice.surface), 1e-14);
  EXPECT_EQ(at_cells(measured, 5, 5).how, AtCells::How::interpolated);
  try {
    at_cells(measured, 0, 5);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()), "`cells` is 0 a side; give a whole number from 1 to 65536");
  }
}

}  // namespace
}  // namespace asperity::at_cells_test
