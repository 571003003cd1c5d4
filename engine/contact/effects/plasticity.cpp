// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/effects/plasticity.hpp"

#include <algorithm>
#include <cmath>

#include "engine/contact/after_event.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/quantities.hpp"
#include "engine/contact/solution.hpp"
#include "engine/contact/state.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

double hardness_of(const Material* material, const std::optional<double>& given, const std::string& body) {
  if (material != nullptr && material->rigid) return never;
  if (given) return *given;
  if (material != nullptr && material->hardness) return *material->hardness;
  const std::string wants = "the effect `plasticity` needs `hardness` of the " + body + " body";
  if (material == nullptr)
    refuse_state(wants + ", which has no material",
                 "give `material=` to the surface, or `hardness` to the effect");
  refuse_state(wants + "; " +
                   (material->name.empty() ? std::string("its material") : quoted(material->name)) +
                   " has none",
               "give it in lab.material{...}, or to the effect");
}

std::string share_text(double share) { return format_short(100 * share, 3) + " %"; }

// E_lower/E_upper; divides the plastic approach at equal hardness.
double modulus_ratio_of(const ContactGeometry& geometry, const Plan& plan) {
  if (!std::isfinite(plan.elasticity->modulus)) return 1;  // rigid
  const auto young = [](const Material* material) {
    return material != nullptr && !material->rigid && material->young ? *material->young : 0.0;
  };
  const double lower = young(lower_material(geometry.lower())),
               upper = young(upper_material(geometry.upper()));
  const double ratio = lower / upper;
  return lower > 0 && upper > 0 && ratio > 0 && std::isfinite(ratio) ? ratio : 1;
}

std::string sharing_text(const PlannedYield& yield) {
  const double share = lower_plastic_share(yield.lower_hardness, yield.upper_hardness, yield.modulus_ratio);
  std::string text = "; the lower body takes " + share_text(share) + " of the plastic change";
  if (!std::isfinite(yield.lower_hardness) || !std::isfinite(yield.upper_hardness)) return text;
  text += ", by the ratio of their " +
          std::string(yield.hardens() ? "hardness at each node, which grows" : "hardness");
  if (yield.modulus_ratio != 1) text += ", and of their `young`";
  return text;
}

// Throws Error{bad_state} naming effect and body if a hardness is missing or no body yields.
void plan_plasticity(const std::any& given, const ContactGeometry& geometry, Plan& plan) {
  const auto& options = std::any_cast<const PlasticityOptions&>(given);
  PlannedYield yield;
  yield.hardening = options.hardening;
  yield.lower_hardness = hardness_of(lower_material(geometry.lower()), options.hardness, "lower");
  yield.upper_hardness = geometry.upper_is_flat()
                             ? never
                             : hardness_of(upper_material(geometry.upper()), options.hardness, "upper");
  const auto rigid = [](const Material* material) { return material != nullptr && material->rigid; };
  if (rigid(lower_material(geometry.lower())) &&
      (geometry.upper_is_flat() || rigid(upper_material(geometry.upper()))))
    refuse_state("the effect `plasticity` has no body that can yield",
                 "give a rough body a material with `hardness`, or leave the effect out");
  yield.modulus_ratio = modulus_ratio_of(geometry, plan);
  std::string sentence =
      std::isfinite(yield.hardness())
          ? "pressure up to " + format_quantity(yield.hardness(), dimension::pressure) +
                (yield.hardens()
                     ? ", then hardening by " + format_quantity(yield.hardening, dimension::stiffness)
                     : std::string()) +
                sharing_text(yield)
          : std::string("nothing yields: the hardness is infinite");
  plan.terms.push_back({"plasticity", std::move(sentence)});
  if (yield.hardens()) {
    const auto bytes = static_cast<std::int64_t>(geometry.grid().nodes() * sizeof(double));
    plan.buffers.push_back({"hardness of each body's nodes, and where they meet", 3 * bytes});
    // Half-spaces: 45 transforms on 256 cells a side, 60 on 512, 100 on 1024. Boxes: none.
    const double more =
        std::max(1.0, std::sqrt(std::sqrt(static_cast<double>(geometry.grid().nodes())) / 256.0));
    plan.transforms *= more;
    if (!plan.elasticity->is_local()) plan.seconds *= more;
  }
  plan.yield = yield;
}

void leave_yielded(const State& state, const Plan& plan, AfterEvent& after) {
  const std::optional<PlasticChange> change = state.plastic_change();
  if (!change) return;
  YieldedBodies bodies = yielded_bodies(after.geometry, *plan.yield, *change);
  after.lower = std::move(bodies.lower);
  after.upper = std::move(bodies.upper);
  if (!bodies.hardness.empty()) after.memory.insert_or_assign(std::string(hardness_memory), bodies.hardness);
  after.mapped_volume = bodies.mapped_volume;
  after.yielded = change->approach;
  after.carried = change->carried;
  after.changed = true;
}

std::vector<StateQuantity> plastic_quantities() {
  using S = State;
  using E = AlgebraicError;
  return {{.name = "plastic_volume",
           .called = "the plastic volume",
           .sentence = "volume this press took from both bodies",
           .dimension = dimension::volume,
           .value = quantity_value<&S::plastic_volume>,
           .bound = quantity_bound<&E::plastic_volume>,
           .cells = CellError{1.5, 2, 1, 1.5}},
          {.name = "plastic_fraction",
           .called = "the plastic fraction",
           .sentence = "share of the tile at the cap",
           .value = quantity_value<&S::plastic_fraction>,
           .bound = quantity_bound<&E::plastic_fraction>,
           .cells = CellError{1, 1.25, 1.2, 1.5, CellError::Kind::steady}}};
}

}  // namespace

const Effect& plasticity_effect() {
  using O = PlasticityOptions;
  static const Effect record{
      .name = "plasticity",
      .sentence = "pressure is limited by hardness, and yielded nodes stay flattened; {} for its defaults",
      .acts = Effect::Acts::bounds_pressure,
      .defaults = O{},
      .options = {quantity_row(
                      "hardness", &O::hardness, dimension::pressure, above(0).or_never(),
                      "greatest pressure a body carries before it yields. Of two bodies the softer one "
                      "limits the pressure and takes nearly all of what yields: a body r times as hard as "
                      "the other takes the share 1/(1 + exp(1.5 (r^2 - 1/r^2)) young/young of the other), "
                      "half of like bodies, .25 at r = 1.2, .06 at 1.5, .004 at 2, as J2 plasticity below "
                      "the surface has it; r is that of each node, with what hardening has made of it")
                      .defaults_to("each body's own"),
                  quantity_row("hardening", &O::hardening, dimension::stiffness, above(0).or_never(),
                               "growth of the pressure with the plastic part of the approach; math.huge "
                               "leaves it out: the pressure stays at the hardness")},
      .plan = plan_plasticity,
      .leave = leave_yielded,
      .keeps = hardness_memory,
      .quantities = plastic_quantities,
      .over_ranks = true};
  return record;
}
const Effect& PlasticityOptions::effect() { return plasticity_effect(); }

}  // namespace asperity
