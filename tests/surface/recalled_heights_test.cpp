// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/generators/recalled_heights.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "engine/surface/generators/bead_blasted.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "engine/surface/generators/weierstrass_mandelbrot.hpp"
#include "tests/core/shelf.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::recalled_heights_test {
namespace {

SelfAffineOptions waves() {
  SelfAffineOptions options = test::self_affine(make_grid(24, 16, 1.5e-3, 1e-3), 0.8, 2e-4);
  options.ra = 1e-6;
  return options;
}

BeadBlastedOptions blast() {
  BeadBlastedOptions options;
  options.grid = make_grid(100, 100, 4e-4, 4e-4);
  options.ra = 3e-6;
  return options;
}

WeierstrassMandelbrotOptions fractal() {
  WeierstrassMandelbrotOptions options;
  options.nx = options.ny = 20;
  options.D = 2.4;
  return options;
}

using Make = std::function<Surface(Monitor&)>;

void expect_the_same_again(const Make& make, int kept) {
  Shelf shelf;
  ShelfMonitor monitor(shelf);
  const Surface alone = make(Monitor::silent());
  const Surface made = make(monitor);
  EXPECT_EQ(shelf.found, 0);
  EXPECT_EQ(static_cast<int>(shelf.results.size()), kept);
  const Surface recalled = make(monitor);
  EXPECT_EQ(shelf.found, kept);
  EXPECT_EQ(made.digest(), alone.digest());
  EXPECT_EQ(recalled.digest(), alone.digest());
  EXPECT_EQ(recalled.traits().aliased_share, alone.traits().aliased_share);
  const int nx = 2 * alone.grid().nx, ny = 2 * alone.grid().ny;
  ASSERT_NE(recalled.recipe(), nullptr);
  EXPECT_EQ((*recalled.recipe())(nx, ny, Monitor::silent()).digest(),
            (*alone.recipe())(nx, ny, Monitor::silent()).digest());
}

TEST(RecalledHeights, AreTheSurfaceThatWasMade) {
  expect_the_same_again([](Monitor& monitor) { return self_affine_surface(waves(), monitor); }, 1);
  expect_the_same_again([](Monitor& monitor) { return weierstrass_mandelbrot(fractal(), monitor); }, 1);
  // Dents and texture are separate.
  expect_the_same_again([](Monitor& monitor) { return bead_blasted_surface(blast(), monitor); }, 2);
}

TEST(RecalledHeights, EveryOptionMakesAnotherKey) {
  Shelf shelf;
  ShelfMonitor monitor(shelf);
  std::size_t made = 0;
  const auto another = [&](auto options, const auto& change, auto generator) {
    change(options);
    generator(options, monitor);
    return shelf.results.size() == ++made;
  };
  const auto self_affine = [&](const std::function<void(SelfAffineOptions&)>& change) {
    return another(waves(), change, self_affine_surface);
  };
  EXPECT_TRUE(self_affine([](auto&) {}));
  EXPECT_TRUE(self_affine([](auto& o) { o.grid.nx = 25; }));
  EXPECT_TRUE(self_affine([](auto& o) { o.grid.size_y = 1.1e-3; }));
  EXPECT_TRUE(self_affine([](auto& o) { o.hurst = 0.7; }));
  EXPECT_TRUE(self_affine([](auto& o) { o.ra = 2e-6; }));
  EXPECT_TRUE(self_affine([](auto& o) { o.ra.reset(), o.rms_height = 1e-6; }));
  EXPECT_TRUE(self_affine([](auto& o) { o.ra.reset(), o.rms_slope = 1e-6; }));
  EXPECT_TRUE(self_affine([](auto& o) { o.long_wave = 1e-3; }));
  EXPECT_TRUE(self_affine([](auto& o) { o.roll_off = 7e-4; }));
  EXPECT_TRUE(self_affine([](auto& o) { o.short_wave = 3e-4; }));
  EXPECT_TRUE(self_affine([](auto& o) { o.seed = 2; }));
  const auto blasted = [&](const std::function<void(BeadBlastedOptions&)>& change) {
    BeadBlastedOptions smooth = blast();
    smooth.fine.reset();
    return another(smooth, change, bead_blasted_surface);
  };
  EXPECT_TRUE(blasted([](auto&) {}));
  EXPECT_TRUE(blasted([](auto& o) { o.bead_low = 260e-6; }));
  EXPECT_TRUE(blasted([](auto& o) { o.bead_high = 310e-6; }));
  EXPECT_TRUE(blasted([](auto& o) { o.dent_low = 26e-6; }));
  EXPECT_TRUE(blasted([](auto& o) { o.dent_high = 61e-6; }));
  EXPECT_TRUE(blasted([](auto& o) { o.coverage = 9; }));
  EXPECT_TRUE(blasted([](auto& o) { o.seed = 2; }));
  const auto mandelbrot = [&](const std::function<void(WeierstrassMandelbrotOptions&)>& change) {
    return another(fractal(), change, weierstrass_mandelbrot);
  };
  EXPECT_TRUE(mandelbrot([](auto&) {}));
  EXPECT_TRUE(mandelbrot([](auto& o) { o.ny = 21; }));
  EXPECT_TRUE(mandelbrot([](auto& o) { o.D = 2.5; }));
  EXPECT_TRUE(mandelbrot([](auto& o) { o.gamma = 1.6; }));
  EXPECT_TRUE(mandelbrot([](auto& o) { o.seed = 2; }));
}

TEST(RecalledHeights, AreKeptOnlyIfTheyTookASecond) {
  Shelf shelf;
  ShelfMonitor monitor(shelf);
  self_affine_surface(waves(), monitor);
  ASSERT_EQ(shelf.results.size(), 1U);
  EXPECT_EQ(shelf.results.begin()->second.least_seconds, 1);
}

}  // namespace
}  // namespace asperity::recalled_heights_test
