// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/slabs/slab_terms.hpp"

#include <limits>
#include <utility>

#include "engine/contact/bodies/elastic_bodies.hpp"
#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/contact/plan.hpp"
#include "engine/core/error.hpp"

namespace asperity {

SlabTerms slab_terms(const std::optional<Material>& lower, const Material& upper, const Effects& effects) {
  SurfaceTraits traits;
  traits.material = lower;
  // Of the bodies only what they are made of matters: a tile of one node stands for them.
  Scene scene{Surface({1, 1, 1, 1}, Field(1, 1), std::move(traits)), upper, Boundary::periodic,
              HalfSpaceOptions{}};
  scene.effects = effects;
  check(scene);
  const ContactGeometry geometry(scene, LatticeIsometry(1, 1));
  SlabTerms terms;
  terms.modulus = contact_modulus(geometry, "the half-space needs `young` and `poisson`", "", "");
  terms.cap = std::numeric_limits<double>::infinity();
  if (const Plan plan = make_plan(scene, geometry); plan.yield) {
    if (plan.yield->hardens())
      throw Error(ErrorCode::bad_value, "`effects.plasticity.hardening` is not computed over ranks",
                  "leave it out, so that the pressure stays at the hardness, or use lab.contact");
    terms.cap = plan.yield->hardness();
  }
  return terms;
}

}  // namespace asperity
