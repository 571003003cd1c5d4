// SPDX-License-Identifier: GPL-3.0-or-later
// Yielding and rigid boxes: answers by hand, bisection in long double, the bearing model, events, hardness
// over thirty decades.
#include "engine/contact/elasticity/box/box_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/box/box_plan.hpp"
#include "tests/contact/contacts.hpp"

namespace asperity::yielding_box_solver_test {
namespace {

using test::boxes;
using test::elastic;
using test::error_of;
using test::random_surface;
using test::ready;
using test::row_of;
using test::surface_of;

constexpr double never = std::numeric_limits<double>::infinity();

Scene yielding(Surface lower, Elasticity elasticity, PlasticityOptions plasticity) {
  Scene scene{std::move(lower), rigid_material(), Boundary::free, elasticity, Accuracy{}};
  scene.effects.set(plasticity);
  return scene;
}
State press(const Scene& scene, double pressure) {
  return ready(scene)->press({PressBy::pressure, pressure, {}});
}

// Drops 0, 1/2, 5/6 and 1 under a plane at 0.6: depths 0.6, 0.1, 0, 0.
const Surface four = row_of({0, 1.0 / 6, 3.0 / 6, 1});

TEST(YieldingBoxSolver, FourBoxesByHandUnderACap) {
  const State st = press(yielding(four, BoxOptions{1}, {.hardness = 0.3}), 0.1);
  EXPECT_NEAR(st.approach(), 0.6, 1e-15);
  const auto pressure = st.field("pressure");
  EXPECT_EQ((*pressure)[3], 0.3);
  EXPECT_NEAR((*pressure)[2], 0.1, 1e-15);
  EXPECT_EQ((*pressure)[1], 0);
  EXPECT_EQ(st.contacts(), 2);
  EXPECT_EQ(st.plastic_fraction(), 0.25);
  EXPECT_NEAR(st.plastic_volume(), 0.3, 1e-15);
  EXPECT_NEAR(st.energy(), 0.5 * (0.09 + 0.01), 1e-15);
  EXPECT_EQ(st.peak_pressure(), 0.3);
  EXPECT_EQ(st.stiffness(), 0.25) << "one element in four still gives way elastically";
  EXPECT_LT(st.residual(), 1e-14);
}

TEST(YieldingBoxSolver, FourBoxesByHandWithHardening) {
  // Above 0.3, half the stiffness: 0.3 + 0.5 · 0.3 = 0.45.
  const State st = press(yielding(four, BoxOptions{1}, {.hardness = 0.3, .hardening = 1}), 0.55 / 4);
  EXPECT_NEAR(st.approach(), 0.6, 1e-15);
  EXPECT_NEAR(st.peak_pressure(), 0.45, 1e-15);
  EXPECT_NEAR(st.plastic_volume(), 0.15, 1e-15);
  EXPECT_NEAR(st.stiffness(), 1.5 / 4, 1e-15);
}

TEST(YieldingBoxSolver, RigidBoxesByHand) {
  // The highest and a fifth of the next.
  const State st = press(yielding(four, RigidOptions{}, {.hardness = 0.3}), 0.3 * 1.2 / 4);
  EXPECT_EQ(st.approach(), 0.5);
  const auto pressure = st.field("pressure");
  EXPECT_EQ((*pressure)[3], 0.3);
  EXPECT_NEAR((*pressure)[2], 0.06, 1e-15);
  EXPECT_EQ(st.contacts(), 2);
  EXPECT_NEAR(st.plastic_volume(), 0.5, 1e-15);
  EXPECT_EQ(st.energy(), 0);
  const auto displacement = st.field("displacement");
  EXPECT_EQ(range(displacement->values()).max, 0) << "nothing of it is elastic";
}

TEST(YieldingBoxSolver, TheFirstRigidBoxCarriesALightLoadAtNoDepth) {
  const State st = press(yielding(four, RigidOptions{}, {.hardness = 0.3}), 1e-3);
  EXPECT_EQ(st.approach(), 0);
  EXPECT_EQ(st.contacts(), 1);
  EXPECT_NEAR(st.peak_pressure(), 4e-3, 1e-17);
  EXPECT_EQ(st.plastic_volume(), 0);
}

// Contact area = load/hardness.
TEST(YieldingBoxSolver, RigidBodiesBearOnTheLoadOverTheHardness) {
  const Surface rough = random_surface(50, 40, 3);
  std::vector<double> sorted(rough.heights().values().begin(), rough.heights().values().end());
  std::sort(sorted.rbegin(), sorted.rend());
  const auto solver = ready(yielding(rough, RigidOptions{}, {.hardness = 2e9}));
  for (const int nodes : {1, 2, 17, 256, 257, 1000, 1999}) {
    const State st = solver->press({PressBy::pressure, 2e9 * (nodes - 0.5) / 2000, {}});
    EXPECT_EQ(st.contacts(), nodes);
    EXPECT_EQ(st.approach(), sorted[0] - sorted[static_cast<std::size_t>(nodes - 1)]);
    double volume = 0;
    for (int k = 0; k < nodes; ++k)
      volume += sorted[static_cast<std::size_t>(k)] - sorted[static_cast<std::size_t>(nodes - 1)];
    EXPECT_NEAR(st.plastic_volume(), volume / 2000, 1e-12 * volume);
    EXPECT_LT(st.residual(), 1e-13);
  }
}

struct Law {
  const char* name;
  double stiffness, hardening;
};
class YieldingBoxes : public ::testing::TestWithParam<Law> {};

// Shares no code with the solver.
TEST_P(YieldingBoxes, AgreeWithBisectionToTheSum) {
  const char* const name = GetParam().name;
  const double k = GetParam().stiffness, hardening = GetParam().hardening;
  const Surface rough = random_surface(40, 31, 7);
  const double peak = rough.height_range().max, hardness = 0.8;
  Scene scene = yielding(rough, std::isinf(k) ? Elasticity(RigidOptions{}) : Elasticity(BoxOptions{k}),
                         {.hardness = hardness, .hardening = hardening});
  const auto solver = ready(scene);
  const auto carried = [&](long double d) {
    long double sum = 0;
    for (const double h : rough.heights().values()) {
      const long double depth = d - static_cast<long double>(peak - h);
      if (depth < 0) continue;
      const long double past = depth - static_cast<long double>(hardness) / static_cast<long double>(k);
      const long double series =
          1 / (1 / static_cast<long double>(k) + 1 / static_cast<long double>(hardening));
      sum += past < 0 ? k * depth : hardness + (std::isinf(hardening) ? 0 : series * past);
    }
    return sum / static_cast<long double>(rough.heights().size());
  };
  for (double pressure = 1e-6; pressure < 0.79; pressure *= 2.9) {
    long double low = 0, high = 100;
    while (carried(high) < pressure) high *= 2;
    for (int step = 0; step < 120; ++step) {
      const long double middle = (low + high) / 2;
      (carried(middle) < pressure ? low : high) = middle;
    }
    const State st = solver->press({PressBy::pressure, pressure, {}});
    EXPECT_NEAR(st.approach(), static_cast<double>(high), 1e-13 * st.approach() + 1e-30)
        << name << " " << pressure;
    EXPECT_LT(st.residual(), 1e-14 + 1e-15 * st.approach()) << name << " " << pressure;
    const State by_approach = solver->press({PressBy::approach, std::nextafter(st.approach(), 1e9), {}});
    EXPECT_GE(by_approach.pressure(), pressure * (1 - 1e-14));
    EXPECT_LE(st.algebraic_error().approach, 1e-12 * (1 + st.approach()));
    EXPECT_GE(st.algebraic_error().contact_bracket.high, st.contacts());
    EXPECT_LE(st.algebraic_error().contact_bracket.low, st.contacts());
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, YieldingBoxes,
                         ::testing::Values(Law{"capped", 3, never}, Law{"hardening", 3, 0.7},
                                           Law{"nearly_rigid", 1e14, never}, Law{"soft", 1e-6, 1e-3},
                                           Law{"rigid", never, never}, Law{"rigid_hardening", never, 0.7}),
                         [](const auto& law) { return std::string(law.param.name); });

TEST(YieldingBoxSolver, InfiniteHardnessIsNoEffectToTheBit) {
  const Surface rough = random_surface(33, 20, 5);
  Scene scene = boxes(rough, 7);
  const State without = press(scene, 0.4);
  scene.effects.set(PlasticityOptions{.hardness = never});
  const State with = press(scene, 0.4);
  EXPECT_EQ(with.digest(), without.digest());
  EXPECT_EQ(with.energy(), without.energy());
  EXPECT_EQ(with.plastic_volume(), 0);
}

TEST(YieldingBoxSolver, AHardnessNeverReachedIsTheElasticAnswer) {
  const Surface rough = random_surface(33, 20, 5);
  Scene scene = boxes(rough, 7);
  const State elastic_state = press(scene, 0.4);
  for (const double hardening : {never, 1e3}) {
    scene.effects.set(PlasticityOptions{.hardness = 100, .hardening = hardening});
    const State st = press(scene, 0.4);
    EXPECT_NEAR(st.approach(), elastic_state.approach(), 4e-16 * st.approach());
    EXPECT_EQ(st.contacts(), elastic_state.contacts());
    EXPECT_EQ(st.plastic_volume(), 0);
    EXPECT_FALSE(st.plastic_change());
  }
}

TEST(YieldingBoxSolver, NoBitFollowsTheOrderOfTheNodes) {
  const Surface rough = random_surface(37, 21, 9);
  const Surface mirrored =
      surface_of(rough.grid(), [&](int i, int j) { return rough.heights()(36 - i, 20 - j); });
  for (const Elasticity& model : {Elasticity(BoxOptions{2}), Elasticity(RigidOptions{})})
    for (const double hardening : {never, 0.3}) {
      const State a = press(yielding(rough, model, {.hardness = 0.5, .hardening = hardening}), 0.2);
      const State b = press(yielding(mirrored, model, {.hardness = 0.5, .hardening = hardening}), 0.2);
      EXPECT_EQ(a.approach(), b.approach());
      EXPECT_EQ(a.energy(), b.energy());
      EXPECT_EQ(a.plastic_volume(), b.plastic_volume());
      const auto p = a.field("pressure"), q = b.field("pressure");
      for (int j = 0; j < 21; ++j)
        for (int i = 0; i < 37; ++i) ASSERT_EQ((*p)(i, j), (*q)(36 - i, 20 - j));
    }
}

TEST(YieldingBoxSolver, HardCasesEndInAnAnswer) {
  // All nodes share the load.
  for (const Elasticity& model : {Elasticity(BoxOptions{2}), Elasticity(RigidOptions{})}) {
    const State one = press(yielding(row_of({5}), model, {.hardness = 1}), 0.999);
    EXPECT_NEAR(one.peak_pressure(), 0.999, 1e-15);
    const State flat = press(yielding(row_of({1, 1, 1}), model, {.hardness = 1}), 0.5);
    EXPECT_EQ(flat.contacts(), 3);
    EXPECT_NEAR(flat.peak_pressure(), 0.5, 1e-15);
    EXPECT_EQ(flat.plastic_volume(), 0);
    EXPECT_EQ(press(yielding(four, model, {.hardness = 1}), 0).contacts(), 0);
  }
  // Shortened by 1e30 times their heights: equal pressures.
  const State soft = press(yielding(four, BoxOptions{1e-30}, {.hardness = 2}), 1);
  EXPECT_EQ(soft.contacts(), 4);
  EXPECT_NEAR(soft.peak_pressure(), 1, 1e-15);
  for (const double hardness : {1e-15, 1.0, 1e15})
    for (const double softness : {1e3, 1.0, 1e-15, 0.0})
      for (const double height : {1e-15, 1.0, 1e15}) {
        const Surface rough =
            surface_of(Grid{9, 7, 1, 1}, [&](int i, int j) { return height * std::sin(3 * i + 5 * j * j); });
        const Elasticity model =
            softness == 0 ? Elasticity(RigidOptions{}) : Elasticity(BoxOptions{hardness / height / softness});
        const auto solver = ready(yielding(rough, model, {.hardness = hardness}));
        for (const double share : {1e-250, 1e-9, 0.3, 1 - 1e-9, std::nextafter(1.0, 0)}) {
          const State st = solver->press({PressBy::pressure, share * hardness, {}});
          EXPECT_LT(st.residual(), 1e-12) << hardness << " " << softness << " " << height << " " << share;
          EXPECT_LE(st.peak_pressure(), hardness);
          EXPECT_TRUE(std::isfinite(st.energy()) && st.energy() >= 0);
        }
      }
}

TEST(YieldingBoxSolver, RefusesWhatHasNoSolution) {
  EXPECT_NE(
      error_of([] { press(yielding(four, BoxOptions{1}, {.hardness = 2}), 2); }).find("cannot be carried"),
      std::string::npos);
  EXPECT_NE(
      error_of([] { press(yielding(four, RigidOptions{}, {.hardness = 2}), 3); }).find("cannot be carried"),
      std::string::npos);
  Scene bare{four, rigid_material(), Boundary::free, RigidOptions{}, Accuracy{}};
  EXPECT_NE(error_of([&] { check(bare); }).find("does not name `plasticity`"), std::string::npos);
  bare.effects.set(PlasticityOptions{.hardness = never});
  EXPECT_NE(error_of([&] { ready(bare); }).find("their `hardness` is infinite"), std::string::npos);
  bare.effects.set(PlasticityOptions{.hardness = 1e9});
  EXPECT_NE(error_of([&] { press(bare, 1e-280); }).find("too small to mean anything"), std::string::npos);
  EXPECT_NE(error_of([&] {
              ready(bare)->press({PressBy::approach, 1e200, {}});
            }).find("range of a double"),
            std::string::npos);
}

}  // namespace
}  // namespace asperity::yielding_box_solver_test
