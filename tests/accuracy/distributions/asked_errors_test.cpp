// SPDX-License-Identifier: GPL-3.0-or-later
// Requested errors on seeds without tuning: corrected area fraction against 1024 x 1024 cells, cost against
// the default and the cheapest sufficient cells. More: bench/requested_error.lua.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/accuracy/chosen_accuracy.hpp"
#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "engine/surface/generators/bead_blasted.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "engine/surface/generators/sphere.hpp"
#include "engine/surface/generators/weierstrass_mandelbrot.hpp"
#include "engine/surface/operations/placement.hpp"
#include "engine/surface/operations/resampling.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::asked_errors_test {
namespace {

TEST(AskedErrors, AreMetOnHeldOutSeeds) {
  int met = 0, asked = 0, cheaper = 0;
  double worst = 0, of_default = 0, of_choice = 0;
  for (std::uint64_t seed = 201; seed <= 206; ++seed) {
    SelfAffineOptions o = test::self_affine(Grid{256, 256, 1, 1}, 0.8, 1.0 / 16, seed);
    o.rms_slope = 0.1;
    o.roll_off = 0.5;
    Material material;
    material.young = 1e9;
    material.poisson = 0;
    const Surface surface = self_affine_surface(o).with_material(material);
    for (const double p : {2e6, 1e7, 3e7}) {
      const PressRequest request{PressBy::pressure, p, {}};
      const auto press = [&](const Surface& lower, const Accuracy& accuracy) {
        return SpecimenPair({lower, rigid_material(), Boundary::periodic, HalfSpaceOptions{}, accuracy})
            .press(request);
      };
      const double truth = press(at_cells(surface, 1024, 1024).surface, {}).corrected_area_fraction();
      const State usual = press(at_cells(surface, 512, 512).surface, {});
      for (const double error : {0.01, 0.04}) {
        Accuracy accuracy;
        accuracy.asked = AskedError{error, {"corrected_area_fraction"}};
        const State state = press(surface, accuracy);
        const double off = std::abs(state.corrected_area_fraction() / truth - 1);
        ++asked;
        met += off <= error ? 1 : 0;
        worst = std::max(worst, off / error);
        if (error > 0.01) continue;
        const double n = state.chosen()->nx;
        const double cost = state.cost().total.transforms * n * n * std::log2(n) / (512.0 * 512 * 9);
        of_default += usual.cost().total.transforms;
        of_choice += cost;
        cheaper += cost < usual.cost().total.transforms ? 1 : 0;
      }
    }
  }
  std::printf(
      "asked errors: %d of %d met, worst %.2f of what was asked; 1 %% took %.0f transforms of 512 cells "
      "against %.0f by default (cheaper in %d of %d)\n",
      met, asked, worst, of_choice, of_default, cheaper, asked / 2);
  EXPECT_GE(met, 0.95 * asked);
  EXPECT_LT(of_choice, of_default);
}

constexpr double modulus = 1e9;

struct Kind {
  std::string name;
  Surface surface;
  Boundary boundary;
  double pressure;
  double hardness = 0, hardening = 0;
  std::optional<Surface> upper{};
  bool boxes = false;
};

std::vector<Kind> kinds(std::uint64_t seed) {
  const auto k = static_cast<double>(seed % 10);
  const int n = 256;
  std::vector<Kind> all;
  const double radius = 4 + 2 * k, contact = 0.09 + 0.05 * k;
  all.push_back({"ball", sphere_surface({Grid{n, n, 1, 1}, radius, SphereShape::sphere}), Boundary::free,
                 4.0 / 3 * modulus * contact * contact * contact / radius});
  SelfAffineOptions o = test::self_affine(Grid{n, n, 1, 1}, 0.55 + 0.05 * k, 1 / (8 + 4 * k), seed);
  o.rms_slope = 0.1;
  o.roll_off = 0.5;
  const Surface rough = self_affine_surface(o);
  all.push_back({"periodic", rough, Boundary::periodic, 0.1 * modulus * 0.02 * (1 + k)});
  all.push_back({"free", rough, Boundary::free, 0.1 * modulus * 0.005 * (1 + k)});
  all.push_back({"capped", rough, Boundary::periodic, 0.1 * modulus * 0.05, 0.05 * modulus});
  all.push_back({"hardening", rough, Boundary::periodic, 0.1 * modulus * 0.05, 0.04 * modulus, 8 * modulus});
  o.seed = seed + 1000;
  const Surface other = self_affine_surface(o);
  all.push_back({"pairs", rough, Boundary::periodic, 0.1 * modulus * 0.02 * (1 + k), 0, 0, other});
  all.push_back({"hardening pairs", rough, Boundary::periodic, 0.1 * modulus * 0.05, 0.04 * modulus,
                 8 * modulus, other});
  all.push_back({"boxes", rough, Boundary::periodic, 0.1 * modulus * 0.02 * (1 + k), 0, 0, {}, true});
  BeadBlastedOptions b;
  b.grid = Grid{n, n, 0.3e-3, 0.3e-3};
  b.ra = 2e-6;
  b.seed = seed;
  all.push_back({"blasted", bead_blasted_surface(b), Boundary::periodic, 0.006 * (1 + k) * modulus});
  all.push_back({"capped blasted", bead_blasted_surface(b), Boundary::periodic, 0.01 * modulus,
                 0.02 * (1 + k) * modulus});
  WeierstrassMandelbrotOptions w;
  w.nx = w.ny = n;
  w.D = 2.3;
  w.L = 1;
  w.G = 1e-3;
  w.n_max = 6;
  w.seed = seed;
  all.push_back({"wm", weierstrass_mandelbrot(w), Boundary::free, 0.1 * modulus * 0.01 * (1 + k)});
  return all;
}

State pressed(const Kind& kind, int cells, const Accuracy& accuracy) {
  Material material;
  material.young = modulus;
  material.poisson = 0;
  if (kind.hardness > 0) material.hardness = kind.hardness;
  Scene scene{at_cells(kind.surface, cells, cells).surface.with_material(material), rigid_material(),
              kind.boundary, HalfSpaceOptions{}, accuracy};
  // Bodies turn over about the middle node; the shift by a cell aligns all grids.
  if (kind.upper)
    scene.upper =
        shifted(at_cells(*kind.upper, cells, cells).surface, -1.0 / cells, 0).with_material(material);
  if (kind.boxes) scene.elasticity = BoxOptions{.stiffness = 100 * modulus};
  if (kind.hardness > 0) {
    PlasticityOptions yields;
    if (kind.hardening > 0) yields.hardening = kind.hardening;
    scene.effects.set(yields);
  }
  return SpecimenPair(scene).press({PressBy::pressure, kind.pressure, {}});
}

// A press of boxes counts as one transform.
double cost_of(const State& state) {
  const double n = state.grid().nx;
  return std::max(state.cost().total.transforms, 1.0) * n * n * std::log2(n);
}

TEST(AskedErrors, AreMetByScenesOfAllKinds) {
  int met = 0, asked = 0;
  std::vector<double> ratios;
  for (const std::uint64_t seed : {401, 404}) {
    for (const Kind& kind : kinds(seed)) {
      const State finest = pressed(kind, 1024, {});
      const double truth = kind.boxes ? finest.area_fraction() : finest.corrected_area_fraction();
      std::map<double, double> cheapest;
      for (const int cells : {32, 64, 128, 256, 512}) {
        const State state = pressed(kind, cells, {});
        const double off = std::abs(state.corrected_area_fraction() / truth - 1);
        for (const double error : {0.1, 0.03, 0.01})
          if (off <= error && !cheapest.contains(error)) cheapest[error] = cost_of(state);
      }
      for (const double error : {0.1, 0.03, 0.01}) {
        Accuracy accuracy;
        accuracy.asked = AskedError{error, {"corrected_area_fraction"}};
        const State state = pressed(kind, 256, accuracy);
        const double off = std::abs(state.corrected_area_fraction() / truth - 1);
        ++asked;
        met += off <= error ? 1 : 0;
        if (off > error)
          std::printf("  missed: %s, seed %d, %g by %.2f times\n", kind.name.c_str(), static_cast<int>(seed),
                      error, off / error);
        if (!cheapest.contains(error)) continue;
        ratios.push_back(cost_of(state) / cheapest[error]);
        if (ratios.back() > 50)
          std::printf("  dear: %s, seed %d, %g: %.0f times; %s\n", kind.name.c_str(), static_cast<int>(seed),
                      error, ratios.back(), state.chosen()->text().c_str());
      }
    }
  }
  std::ranges::sort(ratios);
  std::printf(
      "asked errors of all kinds: %d of %d met; over the cheapest cells that meet them: %.1f in the "
      "middle, %.1f at 90 %%, worst %.0f\n",
      met, asked, ratios[ratios.size() / 2], ratios[ratios.size() * 9 / 10], ratios.back());
  EXPECT_GE(met, 0.95 * asked);
  EXPECT_LE(ratios[ratios.size() / 2], 1.5);
  EXPECT_LE(ratios[ratios.size() * 9 / 10], 10);
}

}  // namespace
}  // namespace asperity::asked_errors_test
