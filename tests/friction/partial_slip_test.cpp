// SPDX-License-Identifier: GPL-3.0-or-later
// Partial slip as the difference of two contacts: Cattaneo and Mindlin's sphere, boxes, tractions, refusals.
#include "engine/friction/partial_slip.hpp"

#include <cmath>

#include "engine/contact/effects/tangential.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "tests/contact/contacts.hpp"

namespace asperity::partial_slip_test {
namespace {

using test::elastic;
using test::error_of;
using test::random_surface;
using test::ready;
using test::scene_of;
using test::surface_of;

Surface paraboloid(int n, double size) {
  return surface_of(Grid{n, n, size, size}, [&](int i, int j) {
    const double x = (i - n / 2) * size / n, y = (j - n / 2) * size / n;
    return -(x * x + y * y) / 2;
  });
}

Scene tangential(Scene scene, std::optional<double> compliance_ratio = {}) {
  scene.effects.set(TangentialOptions{compliance_ratio});
  return scene;
}

// R = E* = 1, load 1e-3: contact radius (3/4·1e-3)^(1/3), about 0.091.
Scene sphere(int n, const Material& material = elastic(2)) {
  return tangential(Scene{paraboloid(n, 0.26).with_material(material), material, Boundary::free,
                          HalfSpaceOptions{}, Accuracy{}});
}

struct Pulled {
  std::shared_ptr<const Solver> contact;
  State normal;
  explicit Pulled(const Scene& scene, PressBy by = PressBy::load, double value = 1e-3)
      : contact(ready(scene)), normal(contact->press({by, value, {}})) {}
  PartialSlip by(double ratio, double friction = 0.3) const {
    return shear(*contact, normal, {{}, ratio, friction});
  }
};

TEST(PartialSlip, TheStickRadiusOfASphereIsCattaneoAndMindlins) {
  for (const int n : {128, 256}) {
    const Pulled pulled(sphere(n));
    for (const auto& [ratio, radius] : {std::pair{0.2, 0.928318}, {0.5, 0.793701}, {0.9, 0.464159}}) {
      const PartialSlip slip = pulled.by(ratio);
      // An outline of 2π c/h nodes is uncertain by one node.
      const double cells = std::sqrt(static_cast<double>(slip.stick_contacts()) / std::numbers::pi);
      EXPECT_NEAR(std::sqrt(slip.stick_fraction()), radius, 0.25 / cells) << n << " " << ratio;
      EXPECT_FALSE(slip.slides());
    }
  }
}

TEST(PartialSlip, TheSphereShiftsAndStiffensAsMindlinFound) {
  const Pulled pulled(sphere(256));
  const double a = std::cbrt(0.75e-3), friction = 0.3;
  for (const double ratio : {0.2, 0.5, 0.9, 1.0}) {
    const PartialSlip slip = pulled.by(ratio, friction);
    const double left = std::cbrt(1 - ratio);
    EXPECT_NEAR(slip.displacement() / (friction * a * a * (1 - left * left)), 1, 1e-4) << ratio;
    // dQ/dU = 2 a G* c/a, over the tile.
    if (ratio < 1) {
      EXPECT_NEAR(slip.stiffness() * 0.26 * 0.26 / (2 * a * left), 1, 4e-3) << ratio;
    }
  }
}

TEST(PartialSlip, PoissonsRatioScalesTheShiftByMindlinsFactor) {
  for (const double nu : {0.0, 0.3, 0.5}) {
    // E for E* = 1.
    const Pulled pulled(sphere(64, elastic(2 * (1 - nu * nu), nu)));
    const double factor = (2 - nu) / (2 * (1 - nu)), a = std::cbrt(0.75e-3);
    EXPECT_NEAR(pulled.by(0.5).displacement() / (0.3 * a * a * (1 - std::pow(0.5, 2.0 / 3))), factor,
                3e-3 * factor);
    EXPECT_NEAR(*pulled.normal.effects().find<TangentialOptions>()->compliance_ratio, factor, 1e-14);
  }
}

TEST(PartialSlip, UnlikeBodiesShareAsTheirCompliances) {
  const auto geometry = [](const Material& lower, const UpperBody& upper) {
    const Scene scene{paraboloid(8, 1).with_material(lower), upper, Boundary::free, HalfSpaceOptions{},
                      Accuracy{}};
    return ContactGeometry(scene, LatticeIsometry(8, 8));
  };
  EXPECT_DOUBLE_EQ(mindlin_ratio(geometry(elastic(5, 0.3), rigid_material())), 1.7 / 1.4);
  EXPECT_DOUBLE_EQ(dundurs_beta(geometry(elastic(5, 0.3), rigid_material())), 0.5 * 0.4 / 0.7);
  EXPECT_DOUBLE_EQ(dundurs_beta(geometry(elastic(5, 0.5), rigid_material())), 0);
  EXPECT_DOUBLE_EQ(dundurs_beta(geometry(elastic(5, 0.3), elastic(5, 0.3))), 0);
  EXPECT_DOUBLE_EQ(mindlin_ratio(geometry(elastic(5, 0.3), elastic(5, 0.3))), 1.7 / 1.4);
  // G = 1 and ν = 0 on G = 2 and ν = 1/4: Σ (2−ν)/(4G) over Σ (1−ν)/(2G).
  EXPECT_DOUBLE_EQ(mindlin_ratio(geometry(elastic(2, 0), elastic(5, 0.25))),
                   (2 / 4.0 + 1.75 / 8) / (1 / 2.0 + 0.75 / 4));
}

// Paraboloid on boxes: A ∝ δ, F ∝ δ², stick area sqrt(1 − r) of the contact.
TEST(PartialSlip, BoxesHaveAClosedForm) {
  const Pulled pulled(tangential(test::boxes(paraboloid(1024, 0.5), 1), 1.5));
  const double depth = std::sqrt(1e-3 / std::numbers::pi);
  for (const double ratio : {0.1, 0.5, 0.9}) {
    const PartialSlip slip = pulled.by(ratio);
    EXPECT_NEAR(slip.stick_fraction(), std::sqrt(1 - ratio), 2e-3) << ratio;
    EXPECT_NEAR(slip.displacement() / (1.5 * 0.3 * depth * (1 - std::sqrt(1 - ratio))), 1, 5e-3) << ratio;
  }
}

TEST(PartialSlip, TractionsCarryTheForceWithinCoulombsLimit) {
  Scene scene{random_surface(48, 48, 3).with_material(elastic(1)), elastic(1), Boundary::periodic,
              HalfSpaceOptions{}, Accuracy{1e-9}};
  const Pulled pulled(tangential(scene), PressBy::pressure, 0.3);
  for (const double ratio : {0.0, 0.3, 0.8, 1.0}) {
    const PartialSlip slip = pulled.by(ratio);
    const Field shear = slip.field("shear"), stick = slip.field("stick");
    const auto pressure = pulled.normal.field("pressure");
    EXPECT_NEAR(block_sum(shear.values()) * scene.lower.grid().cell_area(), slip.force(),
                1e-9 * pulled.normal.load());
    EXPECT_NEAR(block_sum(stick.values()), static_cast<double>(slip.stick_contacts()), 0);
    double worst = 0;
    for (std::size_t k = 0; k < shear.size(); ++k) {
      const double limit = 0.3 * (*pressure)[k];
      EXPECT_LE(shear[k], limit);
      if (stick[k] == 0) {
        EXPECT_EQ(shear[k], limit);
      }
      worst = std::min(worst, shear[k]);
    }
    EXPECT_GE(worst, -1e-6);
    EXPECT_NEAR(slip.force(), ratio * 0.3 * pulled.normal.load(), 1e-15);
  }
}

TEST(PartialSlip, StiffnessIsTheSlopeOfForceOverShift) {
  const Pulled pulled(sphere(128));
  const double area = 0.26 * 0.26, step = 1e-3;
  for (const double ratio : {0.2, 0.6}) {
    const double slope = 2 * step * 0.3 * 1e-3 / area /
                         (pulled.by(ratio + step).displacement() - pulled.by(ratio - step).displacement());
    EXPECT_NEAR(pulled.by(ratio).stiffness() / slope, 1, 1e-2);
  }
}

TEST(PartialSlip, WithoutForceAllSticksAndNothingIsSolved) {
  const Pulled pulled(sphere(64));
  const PartialSlip slip = pulled.by(0);
  EXPECT_EQ(slip.slip_fraction(), 0);
  EXPECT_EQ(slip.displacement(), 0);
  EXPECT_EQ(slip.force(), 0);
  EXPECT_EQ(slip.cost().total.transforms, 0);
  EXPECT_EQ(slip.stiffness(), pulled.normal.stiffness());
  EXPECT_EQ(range(slip.field("shear").values()).max, 0);
}

TEST(PartialSlip, AtCoulombsForceAllSlipsAndNothingIsSolved) {
  const Pulled pulled(sphere(64));
  for (const PartialSlip& slip :
       {pulled.by(1), shear(*pulled.contact, pulled.normal, {0.3 * pulled.normal.load(), {}, 0.3})}) {
    EXPECT_TRUE(slip.slides());
    EXPECT_EQ(slip.ratio(), 1);
    EXPECT_EQ(slip.slip_fraction(), 1);
    EXPECT_EQ(slip.stiffness(), 0);
    EXPECT_EQ(slip.displacement(), 0.3 * pulled.normal.approach());
    EXPECT_EQ(slip.cost().total.transforms, 0);
    EXPECT_EQ(range(slip.field("stick").values()).max, 0);
  }
}

TEST(PartialSlip, TheSecondSolveIsItsWholeCost) {
  const Pulled pulled(sphere(64));
  const PartialSlip slip = pulled.by(0.5);
  EXPECT_GT(slip.cost().total.transforms, 0);
  ASSERT_EQ(slip.cost().by_effect.size(), 1U);
  EXPECT_EQ(slip.cost().by_effect[0].first, "tangential");
}

TEST(PartialSlip, AnUlpBelowCoulombsForceIsSolved) {
  const Pulled pulled(sphere(64));
  const PartialSlip slip = pulled.by(std::nextafter(1.0, 0.0));
  EXPECT_GE(slip.stick_contacts(), 1);
  EXPECT_NEAR(slip.displacement() / pulled.by(1).displacement(), 1, 1e-6);
}

TEST(PartialSlip, NamingItChangesNoPress) {
  Scene scene = sphere(64);
  const State with = test::press(scene, PressBy::load, 1e-3);
  scene.effects = {};
  const State without = test::press(scene, PressBy::load, 1e-3);
  EXPECT_EQ(with.digest(), without.digest());
  EXPECT_NEAR(with.cost().total.transforms, without.cost().total.transforms, 1e-9);
  EXPECT_EQ(with.bytes_held(), without.bytes_held());
}

TEST(PartialSlip, WhatMakesNoSenseIsRefusedByName) {
  const Pulled pulled(sphere(32));
  const auto asked = [&](ShearRequest request) {
    return error_of([&] { shear(*pulled.contact, pulled.normal, request); });
  };
  EXPECT_EQ(asked({{}, 1.1, 0.3}),
            "`ratio` is 1.1; it is the shear force over the one that slides: give a number from 0 to 1");
  EXPECT_NE(asked({{}, std::nan(""), 0.3}).find("`ratio`"), std::string::npos);
  EXPECT_EQ(asked({-1.0, {}, 0.3}), "`force` is -1 N; give a finite force from zero up");
  EXPECT_EQ(asked({4e-4, {}, 0.3}),
            "`force` is 400 uN, but the contact slides at 300 uN, friction times load; give less, or a "
            "`ratio` from 0 to 1");
  EXPECT_EQ(asked({{}, 0.5, 0}), "`friction` is 0; give a finite coefficient above zero");
  EXPECT_EQ(asked({{}, {}, 0.3}), "`force` and `ratio` are not given; give one of the two");
  EXPECT_EQ(asked({1e-4, 0.5, 0.3}), "`force` and `ratio` are both given; give one of the two");
  EXPECT_EQ(error_of([&] { pulled.by(0.5).field("sheer"); }),
            "a shear has no field `sheer` (did you mean `shear`?); fields are shear and stick");
  const State loose = pulled.contact->press({PressBy::load, 0, {}});
  EXPECT_NE(error_of([&] {
              shear(*pulled.contact, loose, {{}, 0.5, 0.3});
            }).find("carries no load"),
            std::string::npos);
  Scene plain = sphere(32);
  plain.effects = {};
  const Pulled unnamed(plain);
  EXPECT_EQ(error_of([&] { unnamed.by(0.5); }),
            "partial slip needs the effect `tangential`, which this scene does not name; name tangential={} "
            "in the effects of the contact");
}

}  // namespace
}  // namespace asperity::partial_slip_test
