// SPDX-License-Identifier: GPL-3.0-or-later
// Creep: hardness falls with dwell.
#include "engine/contact/effects/creep.hpp"

#include <cmath>
#include <limits>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "tests/contact/contacts.hpp"

namespace asperity::creep_test {
namespace {

using test::error_of;

Scene plastic_scene() {
  Material metal = test::elastic(70e9, 0.33);
  metal.hardness = 1e9;
  Scene scene{test::random_surface(6, 6, 1).with_material(metal), rigid_material(), Boundary::periodic,
              HalfSpaceOptions{}, Accuracy{}};
  scene.effects.set(PlasticityOptions{});
  return scene;
}

TEST(Creep, SoftensByTheLogarithmOfTheDwell) {
  const CreepOptions creep;  // 0.02, 1 s, 600 s
  EXPECT_EQ(softening(creep, {}), 1);
  EXPECT_EQ(softening(creep, 600.0), 1);
  EXPECT_DOUBLE_EQ(softening(creep, 0.0), 1 + 0.02 * std::log1p(600.0));
  EXPECT_LT(softening(creep, 6000.0), 1);
  EXPECT_EQ(softening({0, 1, 600}, 1e9), 1);
}

TEST(Creep, NeedsPlasticity) {
  Scene scene = plastic_scene();
  scene.effects.set(CreepOptions{});
  EXPECT_EQ(error_of([&] { check(scene); }), "");
  scene.effects.remove<PlasticityOptions>();
  EXPECT_NE(error_of([&] { check(scene); }).find("name `plasticity` as well"), std::string::npos);
}

TEST(Creep, OptionsOutOfRangeAreNamed) {
  Scene scene = plastic_scene();
  for (const auto& [creep, key] :
       {std::pair{CreepOptions{-1, 1, 600}, "`rate`"}, std::pair{CreepOptions{0.02, 0, 600}, "`onset`"},
        std::pair{CreepOptions{0.02, 1, std::numeric_limits<double>::infinity()}, "`reference`"}}) {
    scene.effects.set(creep);
    EXPECT_NE(error_of([&] { check(scene); }).find(key), std::string::npos) << key;
  }
}

}  // namespace
}  // namespace asperity::creep_test
