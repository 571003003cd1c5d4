// SPDX-License-Identifier: GPL-3.0-or-later
// Friction as a sum over junctions: Hertz, boxes, caps, refusals.
#include "engine/friction/junction_law.hpp"

#include <limits>
#include <numbers>

#include "engine/contact/effects/ageing.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "tests/contact/contacts.hpp"

namespace asperity::junction_law_test {
namespace {

using test::boxes;
using test::error_of;
using test::press;
using test::random_surface;
using test::row_of;

constexpr double infinite = std::numeric_limits<double>::infinity();

Surface paraboloid(int n, double size) {
  return test::surface_of(Grid{n, n, size, size}, [&](int i, int j) {
    const double x = (i - n / 2) * size / n, y = (j - n / 2) * size / n;
    return -(x * x + y * y) / 2;
  });
}

double sum_over_nodes(const JunctionLaw& law, const State& st) {
  long double sum = 0;
  const auto pressure = st.field("pressure");
  for (const double p : pressure->values())
    if (p > 0) sum += law.strength(p);
  return static_cast<double>(sum) * st.geometry().grid().cell_area();
}

// Hertz: R = E* = 1, F = 1e-3, τ0 = .01, α = .2, contact radius about .091.
TEST(JunctionLaw, HertzContactWithAndWithoutACap) {
  Scene scene{paraboloid(512, 0.3).with_material(test::elastic(1)), rigid_material(), Boundary::free,
              HalfSpaceOptions{}, Accuracy{}};
  const State st = press(scene, PressBy::load, 1e-3);
  const FrictionResult open = JunctionLaw({.tau0 = 0.01, .alpha = 0.2}).on(st);
  EXPECT_NEAR(open.force, 0.01 * st.area() + 0.2 * st.load(), 1e-12 * open.force);
  EXPECT_NEAR(open.force / 4.593328e-4, 1, 2e-3);
  const JunctionLaw capped({.tau0 = 0.01, .alpha = 0.2, .tau_max = 0.018});
  EXPECT_NEAR(capped.on(st).force / 4.337256e-4, 1, 2e-3);
  EXPECT_NEAR(capped.on(st).force / sum_over_nodes(capped, st), 1, 1e-12);
}

// Boxes: R = k = 1, F = 1e-3, τ0 = .001, α = .2.
TEST(JunctionLaw, ParaboloidWithAndWithoutACap) {
  const State st = press(boxes(paraboloid(2048, 0.5), 1), PressBy::load, 1e-3);
  const FrictionResult open = JunctionLaw({.tau0 = 0.001, .alpha = 0.2}).on(st);
  EXPECT_NEAR(open.force, 3.120998e-4, 3e-3 * 3.120998e-4);
  const FrictionResult capped = JunctionLaw({.tau0 = 0.001, .alpha = 0.2, .tau_max = 0.003}).on(st);
  EXPECT_NEAR(capped.force, 2.734676e-4, 3e-3 * 2.734676e-4);
  // Above p_c = 0.01 of the peak 0.0178412.
  EXPECT_NEAR(capped.capped_fraction, 1 - 0.01 / 0.0178412, 3e-3);
  EXPECT_EQ(open.capped_fraction, 0);
}

TEST(JunctionLaw, WithoutACapItIsTau0AreaPlusAlphaLoad) {
  const JunctionLaw law({.tau0 = 0.03, .alpha = 0.2});
  for (const double pressure : {1e-9, 1e-3, 0.4, 50.0}) {
    const State st = press(boxes(random_surface(80, 50, 1, 3, 4), 2), PressBy::pressure, pressure);
    const FrictionResult r = law.on(st);
    const double expected = 0.03 * st.area() + 0.2 * st.load();
    EXPECT_NEAR(r.force, expected, 1e-12 * expected);
    EXPECT_NEAR(r.force, sum_over_nodes(law, st), 1e-12 * expected);
    EXPECT_EQ(r.mu, r.force / st.load());
    EXPECT_EQ(r.adhesive_force + r.load_force, r.force);
  }
}

TEST(JunctionLaw, WithACapItIsTheSumOverNodes) {
  const State st = press(boxes(random_surface(80, 50, 1, 3, 4), 2), PressBy::pressure, 0.4);
  for (const double cap : {1e-9, 0.02, 0.03, 0.030001, 0.1, 0.5, 0.8, 1.0, 10.0}) {
    const JunctionLaw law({.tau0 = 0.03, .alpha = 0.2, .tau_max = cap});
    const FrictionResult r = law.on(st);
    const double expected = sum_over_nodes(law, st);
    EXPECT_NEAR(r.force, expected, 1e-12 * expected) << cap;
    std::int64_t capped = 0;
    for (const double p : st.field("pressure")->values()) capped += p > 0 && 0.03 + 0.2 * p >= cap ? 1 : 0;
    EXPECT_NEAR(r.capped_fraction, static_cast<double>(capped) / static_cast<double>(st.contacts()), 1e-15)
        << cap;
  }
}

TEST(JunctionLaw, ACapThatBindsEverywhereIsTauMaxTimesArea) {
  const State st = press(boxes(random_surface(80, 50, 1), 2), PressBy::pressure, 0.4);
  for (const double tau0 : {0.0, 1.0, 3.0}) {
    // τ0 = 0: a cap far below every node, 1e-30 of the peak.
    const FrictionResult r = JunctionLaw({.tau0 = tau0, .alpha = 1, .tau_max = 1e-30}).on(st);
    EXPECT_DOUBLE_EQ(r.force, 1e-30 * st.area());
    EXPECT_EQ(r.capped_fraction, 1);
  }
}

TEST(JunctionLaw, YieldPressureStandsForACap) {
  const JunctionLaw law({.tau0 = 0.01, .alpha = 0.1, .yield_pressure = 0.2});
  EXPECT_DOUBLE_EQ(*law.tau_max(), 0.03);
  EXPECT_EQ(law.strength(1e9), *law.tau_max());
  EXPECT_DOUBLE_EQ(law.strength(0.1), 0.02);
  EXPECT_FALSE(JunctionLaw({.tau0 = 1, .alpha = 0, .yield_pressure = 5}).tau_max());
}

TEST(JunctionLaw, ACapAtTau0BindsEveryJunction) {
  const State st = press(boxes(random_surface(80, 50, 1), 2), PressBy::pressure, 0.4);
  for (const double alpha : {0.0, 0.2}) {
    const FrictionResult r = JunctionLaw({.tau0 = 0.03, .alpha = alpha, .tau_max = 0.03}).on(st);
    EXPECT_EQ(r.capped_fraction, 1) << alpha;
    EXPECT_EQ(r.load_force, 0) << alpha;
    EXPECT_DOUBLE_EQ(r.force, 0.03 * st.area()) << alpha;
  }
}

// 1 + 0.5 ln(1 + 6/2) = 1 + ln 2.
TEST(JunctionLaw, RestStrengthensTau0AndNeitherAlphaNorTheCap) {
  Scene scene = boxes(random_surface(80, 50, 1), 2);
  scene.effects.set(AgeingOptions{0.5, 2});
  const State st = press(scene, PressBy::pressure, 0.4);
  const double factor = 1 + std::numbers::ln2;
  const JunctionLaw law({.tau0 = 0.03, .alpha = 0.2});
  const FrictionResult rested = law.on(st, 6.0), fresh = law.on(st);
  EXPECT_DOUBLE_EQ(*rested.strengthening, factor);
  EXPECT_DOUBLE_EQ(rested.adhesive_force, 0.03 * factor * st.area());
  EXPECT_EQ(rested.load_force, fresh.load_force);
  EXPECT_EQ(fresh.strengthening, 1);
  EXPECT_DOUBLE_EQ(JunctionLaw({.tau0 = 0.03, .alpha = 0.2, .tau_max = 0.04}).on(st, 6.0).force,
                   0.04 * st.area());
  EXPECT_DOUBLE_EQ(strengthening(scene.effects, 6.0), factor);
  EXPECT_EQ(strengthening(scene.effects, 0.0), 1);
  EXPECT_EQ(strengthening(Effects(), {}), 1);
}

TEST(JunctionLaw, ARestNeedsAgeingAndIsATime) {
  const Effects ageing(AgeingOptions{0.5, 2});
  EXPECT_EQ(error_of([&] { check_rest(-1.0, ageing); }), "`rest` is -1 s; give a time from zero up");
  EXPECT_EQ(error_of([&] { check_rest(infinite, ageing); }).find("`rest` is inf"), 0U);
  EXPECT_EQ(test::refusal([] { check_rest(0.0, Effects()); }, ErrorCode::bad_state).find("`rest`"), 0U);
  EXPECT_EQ(error_of([&] { check_rest(0.0, ageing); }), "");
  EXPECT_EQ(error_of([] { check_rest({}, Effects()); }), "");
}

TEST(JunctionLaw, AnInfiniteCapIsNone) {
  EXPECT_FALSE(JunctionLaw({.tau0 = 1, .alpha = 1, .tau_max = infinite}).tau_max());
  EXPECT_FALSE(JunctionLaw({.tau0 = 1, .alpha = 1, .yield_pressure = infinite}).tau_max());
  EXPECT_FALSE(JunctionLaw({.tau0 = 1, .alpha = 0, .yield_pressure = infinite}).tau_max());
}

TEST(JunctionLaw, WithoutLoadThereIsNoCoefficient) {
  const State none = press(boxes(row_of({0, 1}), 1), PressBy::load, 0);
  for (const auto cap : {std::optional<double>(), std::optional<double>(0.5)}) {
    const FrictionResult r = JunctionLaw({.tau0 = 1, .alpha = 1, .tau_max = cap}).on(none);
    EXPECT_EQ(r.force, 0);
    EXPECT_FALSE(r.mu.has_value());
    EXPECT_EQ(r.capped_fraction, 0);
  }
}

TEST(JunctionLaw, AsksForNoFieldWithoutACap) {
  const State st = press(boxes(random_surface(100, 100, 1), 2), PressBy::pressure, 0.4);
  const std::int64_t before = memory::held();
  EXPECT_GT(JunctionLaw({.tau0 = 0.03, .alpha = 0.2}).on(st).force, 0);
  EXPECT_GT(JunctionLaw({.tau0 = 0.03, .alpha = 0.2, .tau_max = 0.1}).on(st).force, 0);
  EXPECT_EQ(memory::held(), before);
}

TEST(JunctionLaw, BadNumbersAreRefusedByName) {
  EXPECT_EQ(error_of([] { JunctionLaw({.tau0 = -1, .alpha = 1}); }),
            "`tau0` is -1; give a finite value from zero up");
  EXPECT_EQ(error_of([] { JunctionLaw({.tau0 = 1, .alpha = infinite}); }),
            "`alpha` is inf; give a finite value from zero up");
  EXPECT_EQ(error_of([] { JunctionLaw({.tau0 = 1, .alpha = 1, .tau_max = 0.0}); }),
            "`tau_max` is 0; give a pressure above zero; leave it out for no cap");
  EXPECT_EQ(error_of([] {
              JunctionLaw({.tau0 = 1, .alpha = 1, .tau_max = {}, .yield_pressure = -2.0});
            }).find("`yield_pressure` is -2"),
            0U);
  EXPECT_EQ(
      error_of([] { JunctionLaw({.tau0 = 1, .alpha = 1, .tau_max = 3.0, .yield_pressure = 2.0}); }),
      "`tau_max` and `yield_pressure` are both given; give one: `yield_pressure` means tau_max = tau0 + "
      "alpha yield_pressure");
}

TEST(JunctionLaw, TextNamesItsNumbers) {
  EXPECT_EQ(JunctionLaw({.tau0 = 500e6, .alpha = 0.2}).text(), "tau = 500 MPa + 0.2 P");
  EXPECT_EQ(JunctionLaw({.tau0 = 500e6, .alpha = 0.2, .tau_max = 1e9}).text(),
            "tau = min(500 MPa + 0.2 P, 1 GPa)");
}

}  // namespace
}  // namespace asperity::junction_law_test
