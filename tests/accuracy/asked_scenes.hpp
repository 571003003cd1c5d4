// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes with a requested error: self-affine surfaces, E* = 1 GPa, tile of 1 m.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/contact/scene/scene.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::test {

inline Material elastic_to_yield() {
  Material material;
  material.young = 1e9;
  material.poisson = 0;
  material.hardness = 5e7;
  return material;
}

inline Surface rough(int n, std::uint64_t seed = 1, double waves = 16) {
  SelfAffineOptions o = test::self_affine(Grid{n, n, 1, 1}, 0.8, 1 / waves, seed);
  o.rms_slope = 0.1;
  o.roll_off = 0.5;
  return self_affine_surface(o).with_material(elastic_to_yield());
}

inline Scene asking(Surface lower, UpperBody upper, Boundary boundary, double error,
                    std::vector<std::string> of = {"corrected_area_fraction"}) {
  Scene scene{std::move(lower), std::move(upper), boundary, HalfSpaceOptions{}, Accuracy{}};
  scene.accuracy.asked = AskedError{error, std::move(of)};
  return scene;
}

// The same heights without their generator.
inline Surface measured(const Surface& surface) {
  return Surface(surface.grid(), surface.heights(), surface.traits());
}

}  // namespace asperity::test
