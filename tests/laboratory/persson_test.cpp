// SPDX-License-Identifier: GPL-3.0-or-later
// Real contact area against Persson (2001, J. Chem. Phys. 115, 3840), elastic and with a hardness. Simulated
// κ = A E* h' / (A0 p̄): 1.7 to 2.4; theory: √(8/π) = 1.6.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/contact/solver.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::persson_test {
namespace {

constexpr double slope = 0.1;  // h': E* h' = 0.1 with E* = 1

// Hurst exponent 0.8 down to waves of 8 cells.
Surface surface(std::uint64_t seed) {
  SelfAffineOptions options = test::self_affine(make_grid(512, 512, 512, 512), 0.8, 8, seed);
  options.rms_slope = slope;
  Material material;
  material.young = 1;
  material.poisson = 0;
  return self_affine_surface(options).with_material(material);
}

State pressed(std::uint64_t seed, double pressure, std::optional<double> hardness = {}) {
  Scene scene{surface(seed), rigid_material(), Boundary::periodic, HalfSpaceOptions{}, Accuracy{}};
  if (hardness) scene.effects.set(PlasticityOptions{*hardness});
  return SpecimenPair(scene).press({PressBy::pressure, pressure, {}});
}

TEST(Persson, ElasticAreaIsAnErrorFunction) {
  for (const auto& [share, area] : {std::pair{.01, .0159566}, {.05, .0796557}, {.1, .158519}})
    EXPECT_NEAR(std::erf(std::numbers::sqrt2 * share), area, 1e-6);
}

// Few hills carry a light load, so tiles scatter: means are compared.
constexpr std::uint64_t seeds = 4;

TEST(Persson, SimulatedAreaOverLoadIsInTheKnownRange) {
  for (const double share : {0.01, 0.02, 0.03}) {
    double kappa = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const State state = pressed(seed, share * slope);
      ASSERT_GT(state.area_fraction(), 0.01);
      ASSERT_LT(state.area_fraction(), 0.08);
      kappa += state.corrected_area_fraction() / share / seeds;
    }
    EXPECT_GT(kappa, 1.7) << share;
    EXPECT_LT(kappa, 2.4) << share;
  }
}

// Pressures diffuse from δ(p − p̄) over a variance (E* h')²/4 between absorbing ends at 0 and H.
struct CappedTheory {
  double elastic, capped;
};
CappedTheory capped_theory(double pressure, double hardness) {
  double elastic = 0, carried = 0;
  for (int k = 1; k < 200; ++k) {
    const double wave = k * std::numbers::pi;
    const double weight = 2 / wave * std::sin(wave * pressure / hardness) *
                          std::exp(-wave * wave * slope * slope / (8 * hardness * hardness));
    elastic += weight * (1 - std::cos(wave));
    carried -= weight * hardness * std::cos(wave);  // ∫ p sin(kπp/H) dp of the mode
  }
  return {elastic, (pressure - carried) / hardness};
}

TEST(Persson, CappedAreasOfTheTheory) {
  for (const auto& [pressure, elastic, capped] :
       {std::tuple{.01, .114584, .044054}, {.02, .217947, .093204}}) {
    const CappedTheory theory = capped_theory(pressure, 0.1);
    EXPECT_NEAR(theory.elastic, elastic, 2e-6);
    EXPECT_NEAR(theory.capped, capped, 2e-6);
  }
}

// Total areas differ by a quarter, as without a cap. Real pressures spread less than the theory's (E* h')²/4:
// fewer nodes reach the hardness.
TEST(Persson, SimulatedCappedAreasAreAsFarFromTheTheoryAsElasticOnes) {
  for (const double pressure : {0.01, 0.02}) {
    constexpr double hardness = 0.1;
    const CappedTheory theory = capped_theory(pressure, hardness);
    double touching = 0, capped = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const State state = pressed(seed, pressure, hardness);
      touching += state.corrected_area_fraction() / seeds;
      capped += state.plastic_fraction() / seeds;
      // The load is the sum over elastic and capped nodes.
      const PressureSplit split = state.split(hardness);
      EXPECT_NEAR((split.sum_below + hardness * static_cast<double>(split.above)) /
                      (pressure * static_cast<double>(state.geometry().grid().nodes())),
                  1, 1e-12);
    }
    EXPECT_NEAR(touching / (theory.elastic + theory.capped), 1, 0.25) << pressure;
    EXPECT_LT(capped, theory.capped) << pressure;
    EXPECT_GT(touching - capped, theory.elastic) << pressure;
    EXPECT_GT(capped, 0.4 * theory.capped) << pressure;
  }
}

}  // namespace
}  // namespace asperity::persson_test
