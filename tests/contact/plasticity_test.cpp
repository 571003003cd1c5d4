// SPDX-License-Identifier: GPL-3.0-or-later
// Plasticity: the plan from the materials, and the plastic volume of each body.
#include "engine/contact/effects/plasticity.hpp"

#include <limits>

#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "tests/contact/contacts.hpp"

namespace asperity::plasticity_test {
namespace {

using test::elastic;
using test::error_of;
using test::random_surface;
using test::surface_of;

constexpr double never = std::numeric_limits<double>::infinity();

Material metal(double hardness) {
  Material material = elastic(70e9, 0.33);
  material.hardness = hardness;
  return material;
}

Scene scene_of(Surface lower, UpperBody upper, PlasticityOptions plasticity = {},
               Boundary boundary = Boundary::periodic) {
  Scene scene{std::move(lower), std::move(upper), boundary, HalfSpaceOptions{}, Accuracy{}};
  scene.effects.set(plasticity);
  return scene;
}

ContactGeometry geometry_of(const Scene& scene, const Pose& pose) { return {scene, pose}; }
ContactGeometry geometry_of(const Scene& scene) {
  return {scene, LatticeIsometry(scene.lower.grid().nx, scene.lower.grid().ny)};
}
PlannedYield yield_of(const Scene& scene) {
  check(scene);
  return *make_plan(scene, geometry_of(scene)).yield;
}

const Surface rough = random_surface(6, 6, 1);

TEST(Plasticity, TheSofterBodyLimitsThePressureAndTakesTheGreaterShare) {
  const PlannedYield yield =
      yield_of(scene_of(rough.with_material(metal(1e9)), rough.with_material(metal(3e9))));
  EXPECT_EQ(yield.hardness(), 1e9);
  EXPECT_GT(lower_plastic_share(yield.lower_hardness, yield.upper_hardness), 0.99);
  EXPECT_FALSE(yield.hardens());
}

// Shares of the approach from J2 plasticity below the surface.
TEST(Plasticity, TheShareOfTheHarderBodyFallsSmoothlyToNothing) {
  const auto of_harder = [](double ratio) { return lower_plastic_share(ratio * 1e9, 1e9); };
  EXPECT_EQ(of_harder(1), 0.5);
  EXPECT_NEAR(of_harder(1.2), 0.246, 5e-4);
  EXPECT_NEAR(of_harder(1.5), 0.0625, 5e-5);
  EXPECT_NEAR(of_harder(2), 0.0036, 5e-5);
  EXPECT_LT(of_harder(3), 1e-5);
  double before = 1;
  for (double ratio = 0.2; ratio < 6; ratio *= 1.01) {
    const double share = of_harder(ratio);
    EXPECT_LE(share, before);
    EXPECT_NEAR(share + lower_plastic_share(1e9, ratio * 1e9), 1, 1e-15) << ratio;
    before = share;
  }
  for (const double hard : {1e-300, 1e-3, 1.0, 1e9, 1e300})
    for (const double soft : {1e-300, 1e-3, 1.0, 1e9, 1e300})
      EXPECT_EQ(lower_plastic_share(hard, soft), hard > soft ? 0 : hard < soft ? 1 : 0.5);
}

// The strain below the faces is proportional to 1/E.
TEST(Plasticity, OfOneHardnessTheStifferBodyTakesLessAsItsModulus) {
  Material stiff = metal(1e9), soft = metal(1e9);
  stiff.young = 210e9;
  soft.young = 70e9;
  const auto share = [](const Scene& scene) {
    const PlannedYield yield = yield_of(scene);
    return lower_plastic_share(yield.lower_hardness, yield.upper_hardness, yield.modulus_ratio);
  };
  EXPECT_DOUBLE_EQ(share(scene_of(rough.with_material(stiff), rough.with_material(soft))), 0.25);
  EXPECT_DOUBLE_EQ(share(scene_of(rough.with_material(soft), rough.with_material(stiff))), 0.75);
  EXPECT_EQ(share(scene_of(rough.with_material(stiff), rough.with_material(stiff))), 0.5);
  Scene rigid = scene_of(rough.with_material(stiff), rough.with_material(soft), {}, Boundary::free);
  rigid.elasticity = RigidOptions{};
  EXPECT_EQ(share(rigid), 0.5);
  // A given stiffness needs no modulus, but the moduli set the shares.
  Scene boxes = rigid;
  boxes.elasticity = BoxOptions{1e12};
  EXPECT_DOUBLE_EQ(share(boxes), 0.25);
  Material unknown;
  unknown.hardness = 1e9;
  boxes.upper = rough.with_material(unknown);
  EXPECT_EQ(share(boxes), 0.5);
}

TEST(Plasticity, ThePlanSaysWhoTakesWhatAndByWhat) {
  const auto sentence = [](const Scene& scene) {
    std::string text;
    for (const PlannedTerm& term : make_plan(scene, geometry_of(scene)).terms)
      if (term.effect == "plasticity") text = term.sentence;
    return text;
  };
  const Surface one = rough.with_material(metal(1e9)), other = rough.with_material(metal(1.5e9));
  EXPECT_EQ(sentence(scene_of(one, other)),
            "pressure up to 1 GPa; the lower body takes 93.8 % of the plastic change, by the ratio of their "
            "hardness");
  EXPECT_NE(sentence(scene_of(one, one, {{}, 5e13}))
                .find("50 % of the plastic change, by the ratio of their "
                      "hardness at each node, which grows"),
            std::string::npos);
  EXPECT_NE(
      sentence(scene_of(one, rigid_material())).find("the lower body takes 100 % of the plastic change"),
      std::string::npos);
  EXPECT_EQ(sentence(scene_of(one, rigid_material())).find("ratio"), std::string::npos);
}

TEST(Plasticity, EqualBodiesShareHalfEach) { EXPECT_EQ(lower_plastic_share(1.1e9, 1.1e9), 0.5); }

TEST(Plasticity, SharesHoldForHugeHardness) {
  EXPECT_EQ(lower_plastic_share(1e308, 1e308), 0.5);
  EXPECT_EQ(lower_plastic_share(never, 1e9), 0);
  EXPECT_EQ(lower_plastic_share(1e9, never), 1);
}

TEST(Plasticity, AFlatCounterBodyAndARigidOneTakeNoShare) {
  for (const UpperBody& upper : {UpperBody(metal(5e8)), UpperBody(rigid_material()),
                                 UpperBody(rough.with_material(rigid_material()))}) {
    const PlannedYield yield = yield_of(scene_of(rough.with_material(metal(1e9)), upper));
    EXPECT_EQ(yield.hardness(), 1e9);
    EXPECT_EQ(yield.upper_hardness, never);
  }
}

TEST(Plasticity, AGivenHardnessHoldsForBothBodies) {
  const PlannedYield yield =
      yield_of(scene_of(rough.with_material(metal(1e9)), rough.with_material(metal(3e9)), {2e9, 5e13}));
  EXPECT_EQ(yield.lower_hardness, 2e9);
  EXPECT_EQ(yield.upper_hardness, 2e9);
  EXPECT_TRUE(yield.hardens());
}

TEST(Plasticity, AMissingHardnessNamesEffectAndBody) {
  EXPECT_EQ(error_of([] { yield_of(scene_of(rough.with_material(elastic(1, 0.3)), rigid_material())); }),
            "the effect `plasticity` needs `hardness` of the lower body; its material has none; give it in "
            "lab.material{...}, or to the effect");
  EXPECT_NE(error_of([] {
              yield_of(scene_of(rough.with_material(metal(1)), rough.with_material(elastic(1, 0.3))));
            }).find("of the upper body"),
            std::string::npos);
}

TEST(Plasticity, TwoBodiesThatCannotYieldAreRefused) {
  EXPECT_NE(error_of([] {
              yield_of(scene_of(rough.with_material(rigid_material()), metal(1e9)));
            }).find("no body that can yield"),
            std::string::npos);
}

TEST(Plasticity, OptionsOutOfRangeAreNamed) {
  const Surface lower = rough.with_material(metal(1e9));
  EXPECT_NE(error_of([&] {
              check(scene_of(lower, rigid_material(), {-1.0, never}));
            }).find("`hardness`"),
            std::string::npos);
  EXPECT_NE(error_of([&] {
              check(scene_of(lower, rigid_material(), {{}, 0}));
            }).find("`hardening`"),
            std::string::npos);
}

TEST(Plasticity, EachBodyLosesItsShareWhereItLay) {
  const Grid grid{6, 6, 6, 6};
  const Surface lower = surface_of(grid, [](int i, int j) { return i + 10.0 * j; }).with_material(metal(1e9));
  // Three times the modulus: a quarter of the plastic volume.
  Material stiff = metal(1e9);
  stiff.young = 3 * *metal(1e9).young;
  const Surface upper = surface_of(grid, [](int i, int j) { return 0.5 * i * j; }).with_material(stiff);
  const Scene scene = scene_of(lower, upper);
  const Pose pose(LatticeIsometry(6, 6).turned(1).shifted(2, 5));
  const ContactGeometry geometry = geometry_of(scene, pose);
  PlasticChange change{Field(6, 6), {}};
  change.approach(4, 1) = 0.8;
  change.approach(0, 3) = 0.4;
  const YieldedBodies after = yielded_bodies(geometry, yield_of(scene), change);
  EXPECT_DOUBLE_EQ(after.lower.height(4, 1), lower.height(4, 1) - 0.6);
  EXPECT_DOUBLE_EQ(after.lower.height(0, 3), lower.height(0, 3) - 0.3);
  const auto above = pose.lattice().to_upper(LatticeIsometry::Node{4, 1});
  const Surface& upper_after = std::get<Surface>(after.upper);
  EXPECT_DOUBLE_EQ(upper_after.height(above.i, above.j), upper.height(above.i, above.j) - 0.2);
  int moved = 0;
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 6; ++i)
      moved +=
          (after.lower.height(i, j) != lower.height(i, j)) + (upper_after.height(i, j) != upper.height(i, j));
  EXPECT_EQ(moved, 4);
  // The pair's total loss is w.
  Scene then = scene;
  then.lower = after.lower;
  then.upper = after.upper;
  const ContactGeometry closed = geometry_of(then, pose);
  for (std::size_t k = 0; k < 36; ++k)
    EXPECT_NEAR(geometry.combined()[k] - closed.combined()[k], change.approach[k], 1e-14);
}

TEST(Plasticity, ATurnOffTheLatticeKeepsTheVolume) {
  const int n = 48;
  const Surface body = random_surface(n, n, 2, n, n).with_material(metal(1e9));
  const Scene scene = scene_of(body, body, {}, Boundary::free);
  const Grid& grid = body.grid();
  const Pose pose = Pose(LatticeIsometry(n, n)).turned(0.4, grid);
  PlasticChange change{Field(n, n), {}};
  for (int j = 15; j < 30; ++j)
    for (int i = 12; i < 33; ++i) change.approach(i, j) = 0.01 * ((i + j) % 4);
  const YieldedBodies after = yielded_bodies(geometry_of(scene, pose), yield_of(scene), change);
  double lower_loss = 0, upper_loss = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      lower_loss += body.height(i, j) - after.lower.height(i, j);
      const double loss = body.height(i, j) - std::get<Surface>(after.upper).height(i, j);
      EXPECT_GE(loss, 0);
      upper_loss += loss;
    }
  EXPECT_NEAR(upper_loss / lower_loss, 1, 1e-12);
  EXPECT_NEAR(after.mapped_volume, 1, 0.02);
}

BodyMemory kept(const NodeMemory& hardness) { return {{std::string(hardness_memory), hardness}}; }

TEST(Plasticity, HardeningIsRememberedInEachBodysFrame) {
  const Surface body = rough.with_material(metal(1e9));
  const Scene scene = scene_of(body, body, {{}, 5e13});
  const Pose pose(LatticeIsometry(6, 6).shifted(1, 2));
  PlasticChange change{Field(6, 6), Field(6, 6)};
  change.approach(3, 3) = 1e-7;
  change.hardness(3, 3) = 1.5e9;
  const YieldedBodies after = yielded_bodies(geometry_of(scene, pose), yield_of(scene), change);
  EXPECT_EQ((*after.hardness.lower)(3, 3), 1.5e9);
  EXPECT_EQ((*after.hardness.lower)(0, 0), 1e9);
  const auto above = pose.lattice().to_upper(LatticeIsometry::Node{3, 3});
  EXPECT_EQ((*after.hardness.upper)(above.i, above.j), 1.5e9);
  // The hard node of each body meets a soft node.
  const ContactGeometry elsewhere(scene, LatticeIsometry(6, 6).shifted(2, 2), kept(after.hardness));
  const MetMemory local = local_hardness(elsewhere, yield_of(scene));
  int both = 0;
  for (std::size_t k = 0; k < 36; ++k) both += (*local.lower)[k] > 1e9 && (*local.upper)[k] > 1e9;
  EXPECT_EQ(both, 0);
}

TEST(Plasticity, SharesGoByWhatEachNodeHasHardenedTo) {
  const Surface body = rough.with_material(metal(1e9));
  const Scene scene = scene_of(body, body, {{}, 5e13});
  const LatticeIsometry lattice(6, 6);
  NodeMemory memory;
  Field hardened(6, 6, 1e9);
  hardened(2, 2) = 1.5e9;
  memory.lower = std::make_shared<const Field>(std::move(hardened));
  const ContactGeometry geometry(scene, lattice, kept(memory));
  PlasticChange change{Field(6, 6), Field(6, 6)};
  for (const int i : {2, 4}) {
    change.approach(i, 2) = 1;
    change.hardness(i, 2) = 2e9;
  }
  const YieldedBodies after = yielded_bodies(geometry, yield_of(scene), change);
  EXPECT_DOUBLE_EQ(after.lower.height(4, 2), body.height(4, 2) - 0.5);
  EXPECT_NEAR(after.lower.height(2, 2), body.height(2, 2) - lower_plastic_share(1.5e9, 1e9), 1e-15);
}

}  // namespace
}  // namespace asperity::plasticity_test
