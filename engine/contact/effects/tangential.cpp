// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/effects/tangential.hpp"

#include <cmath>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/plan.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

// 1/G and ν; zero if rigid. Elasticity has checked both.
struct Shear {
  double compliance = 0, poisson = 0;
};
Shear shear_of(const Material* material) {
  if (material == nullptr || material->rigid) return {};
  return {2 * (1 + *material->poisson) / *material->young, *material->poisson};
}

struct Sums {
  double tangential = 0, normal = 0, mixed = 0;
};
Sums sums_of(const ContactGeometry& geometry) {
  const Shear lower = shear_of(lower_material(geometry.lower())),
              upper = shear_of(upper_material(geometry.upper()));
  Sums sums;
  for (const Shear& body : {lower, upper}) {
    sums.tangential += (2 - body.poisson) * body.compliance / 4;
    sums.normal += (1 - body.poisson) * body.compliance / 2;
  }
  sums.mixed = ((1 - 2 * lower.poisson) * lower.compliance - (1 - 2 * upper.poisson) * upper.compliance) / 4;
  return sums;
}

void check_tangential(const std::any&, const Scene& scene) {
  if (!scene.elasticity.model().shear)
    refuse(
        "`tangential` is not computed on " + std::string(scene.elasticity.model().noun) + " by this version",
        "give elasticity=\"half_space\", or leave it out");
  if (scene.effects.has<PlasticityOptions>())
    refuse(
        "`tangential` needs an elastic contact, and `plasticity` is given as well",
        "put copies of the pressed bodies into a contact without `plasticity`, or leave one of the two out");
}

void plan_tangential(const std::any& given, const ContactGeometry& geometry, Plan& plan) {
  const auto& options = std::any_cast<const TangentialOptions&>(given);
  TangentialOptions filled = options;
  std::string sentence;
  if (plan.elasticity->is_local()) {
    if (!options.compliance_ratio)
      refuse(
          "the effect `tangential` needs `compliance_ratio` on box elements, which have no Poisson's ratio",
          "give the tangential over the normal compliance of a box, such as 2 for upright columns");
  } else {
    if (!options.compliance_ratio) filled.compliance_ratio = mindlin_ratio(geometry);
    constexpr double noticeable = 0.01;
    const double beta = dundurs_beta(geometry);
    if (std::abs(beta) >= noticeable)
      sentence =
          "; Dundurs' beta is " + format_short(beta, 2) + ": the coupling of shear and pressure is neglected";
  }
  plan.effects.set(filled);
  plan.terms.push_back({"tangential", "sideways the bodies give way " +
                                          format_short(*filled.compliance_ratio) +
                                          " times as much as normally" + std::move(sentence)});
}

}  // namespace

double mindlin_ratio(const ContactGeometry& geometry) {
  const Sums sums = sums_of(geometry);
  return sums.tangential / sums.normal;
}

double dundurs_beta(const ContactGeometry& geometry) {
  const Sums sums = sums_of(geometry);
  return sums.mixed / sums.normal;
}

const Effect& tangential_effect() {
  using O = TangentialOptions;
  static const Effect record{
      .name = "tangential",
      .sentence = "shear and partial slip, for contact:shear and stage:slip_growth; {} for its defaults",
      .acts = Effect::Acts::reads_state,
      .defaults = O{},
      .options = {number_row("compliance_ratio", &O::compliance_ratio, above(0),
                             "how much more the bodies give way sideways than normally; required for boxes")
                      .defaults_to("Mindlin's, (2 - poisson)/(2(1 - poisson)) for like bodies")},
      .check = check_tangential,
      .plan = plan_tangential};
  return record;
}
const Effect& TangentialOptions::effect() { return tangential_effect(); }

}  // namespace asperity
