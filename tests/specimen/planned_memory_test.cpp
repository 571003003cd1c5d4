// SPDX-License-Identifier: GPL-3.0-or-later
// Memory of a press and of the deformed bodies, against the plan.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "tests/contact/contacts.hpp"

namespace asperity::planned_memory_test {
namespace {

using test::elastic;
using test::random_surface;
using test::scene_of;

TEST(PlannedMemory, OfElementsIsNotExceeded) {
  const std::vector<std::pair<int, int>> tiles{{1, 37}, {64, 64}, {251, 127}, {512, 512}};
  for (const Boundary boundary : {Boundary::periodic, Boundary::free})
    for (const auto& [nx, ny] : tiles)
      for (const bool hardens : {false, true})
        for (const bool two : {false, true})
          for (const bool is_rigid : {false, true}) {
            Material metal = elastic(1e11);
            metal.hardness = 1e9;
            const Surface lower = random_surface(nx, ny, 1).with_material(metal);
            Scene scene = two ? scene_of(lower, random_surface(nx, ny, 2).with_material(metal), {}, boundary)
                              : scene_of(lower, rigid_material(), {}, boundary);
            if (is_rigid) scene.elasticity = RigidOptions{};
            PlasticityOptions plasticity;
            if (hardens) plasticity.hardening = 1e10;
            scene.effects.set(plasticity);
            SpecimenPair pair(scene);
            const std::int64_t said = pair.plan().bytes_peak();
            const std::int64_t taken = pair.press({PressBy::pressure, 3e8, {}}).cost().total.bytes;
            const auto where = std::to_string(nx) + " x " + std::to_string(ny) +
                               (hardens ? ", hardening" : "") + (two ? ", two rough bodies" : "") +
                               (is_rigid ? ", rigid" : "");
            EXPECT_LE(taken, said) << where;
            EXPECT_LE(said, 2 * taken + (std::int64_t{1} << 20)) << where;
          }
}

}  // namespace
}  // namespace asperity::planned_memory_test
