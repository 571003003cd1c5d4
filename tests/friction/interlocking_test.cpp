// SPDX-License-Identifier: GPL-3.0-or-later
// Inclined junctions against closed forms and bisection; inclines, saw-teeth, and wavy half-spaces, whose
// elastic energy supplies the work against slopes.
#include "engine/core/constants.hpp"
#include "engine/friction/junction_law.hpp"

#include <cmath>

#include "engine/contact/effects/interlocking.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "tests/contact/contacts.hpp"

namespace asperity::interlocking_test {
namespace {

using test::error_of;
using test::press;
using test::random_surface;
using test::scene_of;
using test::surface_of;

Scene interlocking(Scene scene, double direction = 0) {
  scene.effects.set(InterlockingOptions{direction});
  return scene;
}

Scene fitting(const Grid& grid, const std::function<double(int, int)>& height, Boundary boundary) {
  return scene_of(surface_of(grid, height),
                  surface_of(grid, [&](int i, int j) { return -height(grid.nx - 1 - i, j); }), 1.0, boundary);
}

// --- one junction

TEST(InclinedJunction, WithoutAdhesionTheSlopeAddsToTheAngleOfFriction) {
  for (const double friction : {0.0, 5.0, 20.0, 40.0})
    for (const double slope : {-60.0, -25.0, -5.0, 1e-9, 5.0, 25.0, 45.0}) {
      const double phi = friction * pi / 180, b = slope * pi / 180;
      const JunctionLaw law({.tau0 = 0, .alpha = std::tan(phi)});
      const InclinedJunction junction = inclined_junction(law, 3, std::tan(b), 0);
      EXPECT_NEAR(junction.force, 3 * std::tan(phi + b), 1e-13 * (1 + std::abs(junction.force)))
          << friction << " " << slope;
      EXPECT_FALSE(junction.capped);
      EXPECT_FALSE(junction.locks);
    }
}

TEST(InclinedJunction, ALevelOneIsTheLawToTheBit) {
  for (const auto cap : {std::optional<double>(), std::optional<double>(0.5), std::optional<double>(0.05)}) {
    const JunctionLaw law({.tau0 = 0.1, .alpha = 0.3, .tau_max = cap});
    for (const double p : {1e-300, 0.1, 4.0 / 3, 1.4, 7e20}) {
      const InclinedJunction junction = inclined_junction(law, p, 0, 0);
      EXPECT_EQ(junction.force, law.strength(p));
      EXPECT_EQ(junction.capped, cap.has_value() && 0.3 * p >= *cap - 0.1) << p;
    }
  }
}

TEST(InclinedJunction, AdhesionAloneResistsWithTheArea) {
  // α = 0: the stress normal to the junction is P + a τ0, so T = a P + (1 + a²) τ0.
  const JunctionLaw law({.tau0 = 2, .alpha = 0});
  EXPECT_DOUBLE_EQ(inclined_junction(law, 5, 0.5, 0).force, 0.5 * 5 + 1.25 * 2);
  EXPECT_DOUBLE_EQ(inclined_junction(law, 5, -0.5, 0).force, -0.5 * 5 + 1.25 * 2);
}

TEST(InclinedJunction, AGrooveAlongTheWayHasMoreAreaAndMoreNormalStress) {
  // A groove of flank angle b: friction alpha/cos b, as of a wedge.
  const JunctionLaw law({.tau0 = 0.3, .alpha = 0.2});
  for (const double b : {0.1, 0.7, 1.3})
    EXPECT_NEAR(inclined_junction(law, 4, 0, std::tan(b)).force, (0.3 + 0.2 * 4) / std::cos(b), 1e-12) << b;
}

TEST(InclinedJunction, DownASteepWayItPullsNothing) {
  const JunctionLaw law({.tau0 = 2, .alpha = 0.1});
  // At τ0 |a| = P and beyond: the shear is P/|a|, the force 1/|a| of the load.
  EXPECT_NEAR(inclined_junction(law, 1, -0.5, 0).force, 2.0, 1e-14);
  EXPECT_DOUBLE_EQ(inclined_junction(law, 1, -2, 0).force, 0.5);
  EXPECT_DOUBLE_EQ(inclined_junction(law, 1e-6, -0.1, 0).force, 1e-5);
  EXPECT_DOUBLE_EQ(inclined_junction(law, 1e-6, -0.1, 0.3).force, -1e-7 + 1.01 * 1e-6 / 0.1);
}

TEST(InclinedJunction, IsTheGreatestForceThatTheLawAllows) {
  for (const auto cap : {std::optional<double>(), std::optional<double>(1.0), std::optional<double>(0.15)})
    for (const double tau0 : {0.0, 0.2, 3.0})
      for (const double alpha : {0.0, 0.3})
        for (const double p : {0.01, 1.0, 6.0})
          for (const double along : {-4.0, -0.6, 0.0, 0.4, 2.0})
            for (const double across : {0.0, 1.5}) {
              const JunctionLaw law({.tau0 = tau0, .alpha = alpha, .tau_max = cap});
              const InclinedJunction junction = inclined_junction(law, p, along, across);
              const double q = std::sqrt(1 + across * across / (1 + along * along));
              // Bisection: allowed shears form an interval from zero.
              double allowed = 0, refused = 1e3;
              for (int halving = 0; halving < 100; ++halving) {
                const double shear = 0.5 * (allowed + refused), normal = p + along * q * shear;
                const bool fits = normal >= 0 && shear <= law.strength(normal);
                (fits ? allowed : refused) = shear;
              }
              const double best = along * p + (1 + along * along) * q * allowed;
              ASSERT_FALSE(junction.locks);
              EXPECT_NEAR(junction.force, best, 1e-12 * (1 + std::abs(best)))
                  << tau0 << " " << alpha << " " << p << " " << along << " " << across;
            }
}

TEST(InclinedJunction, LocksWhereTheAnglesPassARightOneUnlessCapped) {
  const JunctionLaw open({.tau0 = 0.1, .alpha = 0.5});
  EXPECT_FALSE(inclined_junction(open, 1, std::nextafter(2.0, 0.0), 0).locks);
  EXPECT_TRUE(inclined_junction(open, 1, 2, 0).locks);
  EXPECT_TRUE(inclined_junction(open, 1, 1.9, 1).locks);
  const JunctionLaw capped({.tau0 = 0.1, .alpha = 0.5, .tau_max = 0.4});
  const InclinedJunction junction = inclined_junction(capped, 1, 3, 0);
  EXPECT_FALSE(junction.locks);
  EXPECT_TRUE(junction.capped);
  EXPECT_DOUBLE_EQ(junction.force, 3 * 1 + 10 * 0.4);
}

// --- whole contacts

// Without adhesion an incline of angle b is climbed with tan(φ + b) and descended with tan(φ − b).
TEST(Interlocking, AUniformInclineAddsItsAngle) {
  const double slope = 0.3, alpha = 0.2, phi = std::atan(alpha), b = std::atan(slope);
  const Grid grid{24, 10, 2.4, 0.5};
  const Scene scene = fitting(
      grid, [&](int i, int) { return slope * 0.1 * i; }, Boundary::free);
  const JunctionLaw law({.tau0 = 0, .alpha = alpha});
  const auto mu = [&](double direction) {
    return *law.on(press(interlocking(scene, direction), PressBy::pressure, 0.7)).mu;
  };
  EXPECT_NEAR(mu(0), std::tan(phi + b), 1e-12);
  EXPECT_NEAR(mu(pi), std::tan(phi - b), 1e-12);
  EXPECT_NEAR(mu(pi / 2), alpha / std::cos(b), 1e-12);
  const double turned = pi / 6, along = slope * std::cos(turned), across = slope * std::sin(turned);
  EXPECT_NEAR(mu(turned), inclined_junction(law, 1, along, across).force, 1e-12);
  // Too steep for its friction: slides by itself.
  const Scene steep = fitting(
      grid, [&](int i, int) { return 0.1 * i; }, Boundary::free);
  EXPECT_LT(*law.on(press(interlocking(steep, pi), PressBy::pressure, 0.7)).mu, 0);
}

TEST(Interlocking, PartsOfTheForceAddUp) {
  const Grid grid{24, 10, 2.4, 0.5};
  const State st = press(interlocking(fitting(
                             grid, [](int i, int) { return 0.03 * i; }, Boundary::free)),
                         PressBy::pressure, 0.7);
  const FrictionResult r = JunctionLaw({.tau0 = 0.4, .alpha = 0.2}).on(st);
  EXPECT_NEAR(r.adhesive_force, 0.4 * 1.2, 1e-12);
  EXPECT_NEAR(r.load_force, 0.2 * 0.7 * 1.2, 1e-12);
  ASSERT_TRUE(r.interlocking_force.has_value());
  EXPECT_EQ(r.force, r.adhesive_force + r.load_force + *r.interlocking_force);
  EXPECT_NEAR(r.force / 1.2, (0.3 * 0.7 + 1.09 * (0.4 + 0.2 * 0.7) / (1 - 0.06)), 1e-12);
  EXPECT_EQ(*r.mu, r.force / st.load());
}

// First-order parts of climbing and descending cancel.
TEST(Interlocking, ASymmetricSawToothKeepsWhatIsOfSecondOrder) {
  const int tooth = 16;
  const Grid grid{64, 4, 64, 4};
  const double slope = 0.5, alpha = 0.3, phi = std::atan(alpha), b = std::atan(slope);
  const auto height = [&](int i, int) {
    const int k = i % tooth;
    return slope * std::min(k, tooth - k);
  };
  const State st = press(interlocking(fitting(grid, height, Boundary::periodic)), PressBy::pressure, 0.01);
  // Level at crest and valley: two of sixteen nodes.
  const double flanks = 7.0 / 16 * (std::tan(phi + b) + std::tan(phi - b)) + 2.0 / 16 * alpha;
  const JunctionLaw law({.tau0 = 0, .alpha = alpha});
  EXPECT_NEAR(*law.on(st).mu, flanks, 1e-12);
  EXPECT_GT(flanks, alpha);
  EXPECT_NEAR(JunctionLaw({.tau0 = 0, .alpha = 0}).on(st).force, 0, 1e-14);
}

TEST(Interlocking, LevelBodiesGiveTheVeryNumbersOfTheLaw) {
  const Grid grid{8, 6, 1, 1};
  // Contact nodes are level with their neighbours.
  const Scene plain = fitting(
      grid, [](int, int) { return 2.0; }, Boundary::periodic);
  for (const auto cap : {std::optional<double>(), std::optional<double>(0.2), std::optional<double>(0.9)}) {
    const JunctionLaw law({.tau0 = 0.1, .alpha = 0.3, .tau_max = cap});
    const FrictionResult without = law.on(press(plain, PressBy::pressure, 0.7));
    const FrictionResult with = law.on(press(interlocking(plain), PressBy::pressure, 0.7));
    EXPECT_EQ(*with.interlocking_force, 0);
    EXPECT_FALSE(without.interlocking_force.has_value());
    EXPECT_EQ(with.force, without.force);
    EXPECT_EQ(*with.mu, *without.mu);
    EXPECT_EQ(with.adhesive_force, without.adhesive_force);
    EXPECT_EQ(with.load_force, without.load_force);
    EXPECT_EQ(with.capped_fraction, without.capped_fraction);
  }
}

TEST(Interlocking, ARigidLevelBodyMakesTheJunctionsLevel) {
  Surface rough = random_surface(30, 30, 1).with_material(test::elastic(1));
  const Surface level =
      surface_of(rough.grid(), [](int, int) { return 0.0; }).with_material(rigid_material());
  const State st = press(interlocking(scene_of(rough, level, 1.0)), PressBy::approach, 20);
  ASSERT_EQ(st.contacts(), 900);
  EXPECT_NEAR(*JunctionLaw({.tau0 = 0, .alpha = 0.2}).on(st).interlocking_force, 0, 1e-10 * st.load());
}

TEST(Interlocking, WithoutContactThereIsNothing) {
  const Scene scene = interlocking(scene_of(random_surface(10, 10, 1), random_surface(10, 10, 2), 1.0));
  const FrictionResult r = JunctionLaw({.tau0 = 1, .alpha = 1}).on(press(scene, PressBy::load, 0));
  EXPECT_EQ(r.force, 0);
  EXPECT_EQ(*r.interlocking_force, 0);
  EXPECT_FALSE(r.mu.has_value());
  EXPECT_EQ(r.capped_fraction, 0);
}

// Fixed approach, a cell each way: work against the slopes is the gain of elastic energy.
TEST(Interlocking, WithoutFrictionTheSlopesResistWhatTheEnergyGains) {
  const int n = 128;
  const Grid grid{n, n, 1, 1};
  const auto wave = [&](double phase_x, double phase_y, double amplitude) {
    return surface_of(grid, [=](int i, int j) {
      const double x = 2 * pi * i / n, y = 2 * pi * j / n;
      return amplitude * (std::cos(x + phase_x) * std::cos(y + phase_y) + 0.3 * std::cos(2 * x + y));
    });
  };
  // Unlike bodies: the interface is not their mean.
  const Surface lower = wave(0.3, 0.1, 0.02).with_material(test::elastic(1)),
                upper = wave(1.1, 2.0, 0.01).with_material(test::elastic(3));
  const auto moved = [&](int cells) {
    Scene scene{lower, upper, Boundary::periodic, HalfSpaceOptions{}, Accuracy{1e-9}};
    scene.effects.set(InterlockingOptions{});
    check(scene);
    auto geometry = std::make_shared<const ContactGeometry>(scene, LatticeIsometry(n, n).shifted(cells, 0));
    // Fixed mean planes: level motion.
    const double separation = 0.008;
    const double approach = geometry->combined_range().max - mean(geometry->combined().values()) - separation;
    return make_solver(make_plan(scene, *geometry), geometry)->press({PressBy::approach, approach, {}});
  };
  const State here = moved(0);
  ASSERT_GT(here.contacts(), 1000);
  ASSERT_LT(here.contacts(), n * n);
  const double gain = (moved(1).energy() - moved(-1).energy()) / (2.0 / n);
  const FrictionResult r = JunctionLaw({.tau0 = 0, .alpha = 0}).on(here);
  EXPECT_GT(std::abs(gain), 1e-3 * here.load());
  EXPECT_NEAR(*r.interlocking_force, gain, 2e-3 * std::abs(gain));
}

TEST(Interlocking, LockedJunctionsAskForACap) {
  const Grid grid{24, 10, 2.4, 0.5};
  const State st = press(interlocking(fitting(
                             grid, [](int i, int) { return 0.3 * i; }, Boundary::free)),
                         PressBy::pressure, 0.7);
  EXPECT_EQ(error_of([&] { JunctionLaw({.tau0 = 0, .alpha = 0.4}).on(st); }),
            "240 of 240 junctions are so steep that they lock: their slope times `alpha` is one or more; "
            "give the law a `tau_max`, the strength at which they shear off");
  const FrictionResult r = JunctionLaw({.tau0 = 0, .alpha = 0.4, .tau_max = 0.5}).on(st);
  EXPECT_EQ(r.capped_fraction, 1);
  EXPECT_NEAR(r.force / 1.2, 3 * 0.7 + 10 * 0.5, 1e-11);
}

TEST(Interlocking, AStateThatDoesNotNameItHasNoFieldMade) {
  const State st =
      press(scene_of(random_surface(100, 100, 1), random_surface(100, 100, 2), 1.0), PressBy::pressure, 0.4);
  const std::int64_t before = memory::held();
  EXPECT_GT(JunctionLaw({.tau0 = 0.03, .alpha = 0.2}).on(st).force, 0);
  EXPECT_EQ(memory::held(), before);
}

// One-sided slopes at the rim of the overlap.
TEST(Interlocking, JunctionsBesideGroundThatNothingFacesHaveTheirSlopes) {
  const Grid bar{8, 16, 0.8, 1.6};
  const Scene scene = scene_of(surface_of(bar, [](int i, int j) { return 0.01 * i + 0.02 * j; }),
                               surface_of(bar, [](int, int) { return 0.0; }), 1.0);
  const auto geometry =
      std::make_shared<const ContactGeometry>(scene, Pose(LatticeIsometry(8, 16)).turned(0.5 * pi, bar));
  const State st = make_solver(make_plan(scene, *geometry), geometry)->press({PressBy::indentation, 2, {}});
  ASSERT_EQ(st.contacts(), 64);
  const Slopes slopes = junction_slopes(st);
  for (int j = 4; j < 12; ++j)
    for (int i = 0; i < 8; ++i) {
      EXPECT_NEAR(slopes.x(i, j), 0.05, 1e-12) << i << " " << j;
      EXPECT_NEAR(slopes.y(i, j), 0.10, 1e-12) << i << " " << j;
    }
}

}  // namespace
}  // namespace asperity::interlocking_test
