// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/effects/adhesion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "engine/contact/effects/capillarity.hpp"
#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/effects/tangential.hpp"
#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "tests/contact/contacts.hpp"

namespace asperity::adhesion_test {
namespace {

using test::elastic;
using test::error_of;
using test::press;
using test::ready;
using test::surface_of;

// A paraboloid of radius 1 m on a tile of 1 m, E* = 1 Pa, under a rigid flat.
Scene paraboloid(int n = 32) {
  Surface body = surface_of(make_grid(n, n, 1, 1), [n](int i, int j) {
    const double x = (i + 0.5) / n - 0.5, y = (j + 0.5) / n - 0.5;
    return -0.5 * (x * x + y * y);
  });
  SurfaceTraits traits;
  traits.material = elastic(1);
  Scene scene{Surface(body.grid(), body.heights(), traits), rigid_material(), Boundary::free,
              HalfSpaceOptions{}, Accuracy{}};
  scene.accuracy.tolerance = 1e-5;
  return scene;
}
Scene adhering(double work, double range = 0.05, GapLaw model = GapLaw::exponential) {
  Scene scene = paraboloid();
  scene.effects.set(AdhesionOptions{work, range, model});
  return scene;
}

TEST(Adhesion, WithoutWorkItIsTheContactWithoutIt) {
  const State with = press(adhering(0), PressBy::load, 0.01),
              without = press(paraboloid(), PressBy::load, 0.01);
  EXPECT_EQ(with.digest(), without.digest());
  EXPECT_EQ(with.effects_run().back(), "adhesion");
  EXPECT_EQ(with.cost().total.transforms, without.cost().total.transforms);
}

TEST(Adhesion, UnnamedItCostsNothing) {
  const State state = press(paraboloid(), PressBy::load, 0.01);
  for (const auto& [effect, cost] : state.cost().by_effect) EXPECT_EQ(effect, "elasticity");
  EXPECT_EQ(state.attraction(), 0);
}

TEST(Adhesion, HoldsBodiesTogetherWithoutALoad) {
  for (const GapLaw model : {GapLaw::exponential, GapLaw::dugdale}) {
    const State state = press(adhering(0.01, 0.05, model), PressBy::load, 0);
    EXPECT_EQ(state.load(), 0);
    EXPECT_GT(state.contacts(), 0);
    EXPECT_GT(state.approach(), 0);
    EXPECT_TRUE(state.converged()) << state.text();
    double sum = 0;
    for (const double p : state.field("pressure")->values()) sum += p;
    EXPECT_NEAR(sum * state.geometry().grid().cell_area(), state.attraction(), 1e-9 * state.attraction());
    ASSERT_EQ(state.cost().by_effect.size(), 2U);
    EXPECT_EQ(state.cost().by_effect.front().first, "elasticity");
    EXPECT_EQ(state.cost().by_effect.back().first, "adhesion");
    for (const auto& [effect, cost] : state.cost().by_effect) EXPECT_GT(cost.transforms, 0) << effect;
  }
}

TEST(Adhesion, APullIsCarriedUpToThePullOff) {
  const auto contact = ready(adhering(0.01));
  EXPECT_EQ(contact->press({PressBy::load, -0.03, {}}).load(), -0.03);
  const std::string text = error_of([&] { contact->press({PressBy::load, -0.1, {}}); });
  EXPECT_NE(text.find("the bodies separate under a mean pressure of -0.1 Pa"), std::string::npos) << text;
}

TEST(Adhesion, BodiesDrawnApartHoldLongerThanBodiesBroughtTogether) {
  const auto contact = ready(adhering(0.01, 0.02));
  const State coming = contact->press({PressBy::approach, -0.065, {}});
  const State leaving = contact->press({PressBy::approach, -0.065, {}, {0.05}});
  EXPECT_EQ(coming.contacts(), 0);
  EXPECT_GT(leaving.contacts(), 0);
  EXPECT_LT(leaving.load(), coming.load());
}

// Hysteresis along a sweep: after a return from further apart the state is between both branches, because
// nodes at the rim are bistable.
TEST(Adhesion, TurnsGoneThroughBeforeTellTheBranch) {
  const auto contact = ready(adhering(0.01, 0.02));
  const auto at = [&](std::vector<double> turns) {
    return contact->press({PressBy::approach, -0.065, {}, std::move(turns)});
  };
  const State coming = at({}), leaving = at({0.05}), back = at({0.05, -0.07}), lost = at({0.05, -0.3});
  EXPECT_EQ(coming.preload(), std::vector<double>{});
  EXPECT_EQ(back.preload(), (std::vector<double>{0.05, -0.07}));
  EXPECT_EQ(coming.contacts(), 0);
  EXPECT_GT(back.contacts(), 0);
  EXPECT_LE(back.contacts(), leaving.contacts());
  EXPECT_NEAR(back.load(), leaving.load(), 0.1 * std::abs(leaving.load()));
  EXPECT_EQ(lost.contacts(), 0);
  EXPECT_NEAR(lost.load(), coming.load(), 1e-3 * std::abs(coming.load()));
  EXPECT_EQ(contact->press({PressBy::load, -0.01, {}}).preload(), std::vector<double>{0});
}

TEST(Adhesion, DrawnFromTheSameTurnTwiceTheSecondTimeIsCheaperAndTheSame) {
  const PressRequest request{PressBy::approach, -0.05, {}, {0.05}};
  const auto contact = ready(adhering(0.01, 0.02));
  contact->press({PressBy::approach, -0.03, {}, {0.05}});
  const State second = contact->press(request), first = ready(adhering(0.01, 0.02))->press(request);
  EXPECT_EQ(second.digest(), first.digest());
  EXPECT_EQ(second.iterations(), first.iterations());
  EXPECT_LT(second.cost().total.transforms, first.cost().total.transforms);
  EXPECT_EQ(contact->press({PressBy::load, -0.01, {}, {0.05}}).digest(),
            ready(adhering(0.01, 0.02))->press({PressBy::load, -0.01, {}, {0.05}}).digest());
}

TEST(Adhesion, ErrorsAreInfiniteWhereNothingIsBounded) {
  const State state = press(adhering(0.01), PressBy::approach, 0.01);
  const AlgebraicError& error = state.algebraic_error();
  for (const double bound : {error.approach, error.mean_gap, error.energy, error.peak_pressure, *error.load,
                             error.indentation, error.separation, *error.secant_stiffness})
    EXPECT_EQ(bound, std::numeric_limits<double>::infinity());
  EXPECT_EQ(error.contact_bracket.low, 0);
  EXPECT_EQ(error.contact_bracket.high, 32 * 32);
  EXPECT_EQ(state.text().find("±"), std::string::npos) << state.text();
  EXPECT_EQ(state.text().find("inf"), std::string::npos) << state.text();
  const State loaded = press(adhering(0.01), PressBy::load, -0.01);
  EXPECT_LE(*loaded.algebraic_error().load, 1e-14 * 0.01);  // requested load
}

TEST(Adhesion, CapillarityBesideItHasACostOfItsOwn) {
  Scene scene = adhering(0.01, 0.02);
  scene.effects.set(CapillarityOptions{.pressure = 0.1, .surface_tension = 0.005});
  const State state = press(scene, PressBy::load, 0.01);
  std::vector<std::string> effects;
  double transforms = 0;
  for (const auto& [effect, cost] : state.cost().by_effect) {
    effects.push_back(effect);
    transforms += cost.transforms;
    EXPECT_GT(cost.transforms, 0) << effect;
  }
  EXPECT_EQ(effects, (std::vector<std::string>{"elasticity", "capillarity", "adhesion"}));
  EXPECT_DOUBLE_EQ(transforms, state.cost().total.transforms);
}

TEST(Adhesion, NumbersTooFarApartAreRefused) {
  const auto contact = ready(adhering(0.01));
  const std::string text = error_of([&] { contact->press({PressBy::approach, 1e308, {}}); });
  EXPECT_NE(text.find("the numbers of this contact overflow"), std::string::npos) << text;
}

TEST(Adhesion, WarnsWhereTheZoneThatPullsIsUnderFourCells) {
  const auto plan_of = [](const Scene& scene) {
    return make_plan(scene, ContactGeometry(scene, LatticeIsometry(32, 32)));
  };
  EXPECT_TRUE(plan_of(adhering(0.01, 0.05)).warnings.empty());
  const Plan coarse = plan_of(adhering(0.01, 0.01));
  ASSERT_EQ(coarse.warnings.size(), 1U);
  EXPECT_NE(coarse.warnings.front().find("`adhesion` acts around a contact in a zone about"),
            std::string::npos);
  EXPECT_TRUE(plan_of(adhering(0, 0.01)).warnings.empty());
}

TEST(Adhesion, WhatItIsNotComputedWithIsRefusedByName) {
  const auto refused = [](const Scene& scene) { return error_of([&] { check(scene); }); };
  EXPECT_EQ(refused(adhering(0.01)), "");
  EXPECT_NE(refused(adhering(-1)).find("`work` of the effect `adhesion` is -1 J/m^2"), std::string::npos);
  EXPECT_NE(refused(adhering(std::numeric_limits<double>::infinity())).find("`work`"), std::string::npos);
  EXPECT_NE(refused(adhering(1, 0)).find("`range` of the effect `adhesion` is 0 m"), std::string::npos);
  Scene scene = adhering(1);
  scene.elasticity = BoxOptions{1.0};
  EXPECT_NE(refused(scene).find("`adhesion` is not computed on box elements"), std::string::npos);
  scene = adhering(1);
  scene.effects.set(PlasticityOptions{1.0});
  EXPECT_NE(refused(scene).find("together with `plasticity`"), std::string::npos);
  scene = adhering(1);
  scene.effects.set(TangentialOptions{});
  EXPECT_NE(refused(scene).find("together with `tangential`"), std::string::npos);
  scene = adhering(1);
  scene.accuracy.precision = Accuracy::Precision::single;
  EXPECT_NE(refused(scene).find("`precision`"), std::string::npos);
  scene = adhering(1);
  scene.accuracy.estimate = Accuracy::Estimate::coarser;
  EXPECT_NE(refused(scene).find("estimate"), std::string::npos);
  scene.effects.find<AdhesionOptions>()->work = 0;
  scene.effects.set(PlasticityOptions{1.0});
  EXPECT_EQ(refused(scene), "");
}

TEST(Adhesion, RequestsThatMakeNoSenseAreRefused) {
  const auto contact = ready(adhering(0.01)), plain = ready(paraboloid());
  const auto refused = [&](const Solver& on, const PressRequest& request) {
    return error_of([&] { on.press(request); });
  };
  EXPECT_NE(refused(*contact, {PressBy::flatten, 0.5, {}}).find("`flatten` of bodies that attract"),
            std::string::npos);
  EXPECT_NE(refused(*contact, {PressBy::load, std::nan(""), {}}).find("`load` is nan N"), std::string::npos);
  EXPECT_NE(refused(*contact, {PressBy::load, 1, {}, {0.5}}).find("`preload` is 0.5, below the `load` of 1"),
            std::string::npos);
  EXPECT_NE(refused(*plain, {PressBy::load, 1, {}, {2}}).find("nothing attracts the bodies"),
            std::string::npos);
  EXPECT_NE(refused(*plain, {PressBy::load, -1, {}}).find("nothing attracts the bodies"), std::string::npos);
}

}  // namespace
}  // namespace asperity::adhesion_test
