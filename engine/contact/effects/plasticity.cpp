// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/effects/plasticity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/error.hpp"
#include "engine/core/laws_met.hpp"
#include "engine/core/quantity.hpp"
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
    throw Error(ErrorCode::bad_state, wants + ", which has no material",
                "give `material=` to the surface, or `hardness` to the effect");
  throw Error(ErrorCode::bad_state,
              wants + "; " + (material->name.empty() ? std::string("its material") : quoted(material->name)) +
                  " has none",
              "give it in lab.material{...}, or to the effect");
}

// The same hardness everywhere unless events have left a field of it.
Field hardness_field(const std::shared_ptr<const Field>& memory, double virgin, const Grid& grid) {
  return memory ? *memory : Field(grid.nx, grid.ny, virgin);
}

// Raises `memory` (own frame) to the hardness that yielding nodes reached.
std::shared_ptr<const Field> hardened(const std::shared_ptr<const Field>& memory, double virgin,
                                      const Field& reached, const Grid& grid) {
  Field result = hardness_field(memory, virgin, grid);
  for (std::size_t k = 0; k < result.size(); ++k) result[k] = std::max(result[k], reached[k]);
  return std::make_shared<const Field>(std::move(result));
}

Surface with_heights(const Surface& body, Field heights) {
  return Surface(body.grid(), std::move(heights), body.traits());
}

std::string share_text(double share) { return format_short(100 * share, 3) + " %"; }

// E_lower/E_upper, by which bodies of one hardness share what yields below their faces.
double modulus_ratio_of(const ContactGeometry& geometry, const Plan& plan) {
  const auto* box = std::get_if<BoxOperator>(&plan.elasticity);
  if (box != nullptr && !std::isfinite(box->stiffness)) return 1;  // rigid but for what yields
  const auto young = [](const Material* material) {
    return material != nullptr && !material->rigid && material->young ? *material->young : 0.0;
  };
  const double lower = young(lower_material(geometry.lower())),
               upper = young(upper_material(geometry.upper()));
  const double ratio = lower / upper;
  return lower > 0 && upper > 0 && ratio > 0 && std::isfinite(ratio) ? ratio : 1;
}

// How what yields is shared, and by what where both bodies may yield.
std::string sharing_text(const PlannedYield& yield) {
  const double share = lower_plastic_share(yield.lower_hardness, yield.upper_hardness, yield.modulus_ratio);
  std::string text = "; the lower body takes " + share_text(share) + " of what yields";
  if (!std::isfinite(yield.lower_hardness) || !std::isfinite(yield.upper_hardness)) return text;
  text += ", by the ratio of their " +
          std::string(yield.hardens() ? "hardness at each node, which grows" : "hardness");
  if (yield.modulus_ratio != 1) text += ", and of their `young`";
  return text;
}

}  // namespace

double lower_plastic_share(double lower_hardness, double upper_hardness, double modulus_ratio) {
  if (!std::isfinite(upper_hardness)) return 1;
  if (!std::isfinite(lower_hardness)) return 0;
  // Far beyond these ratios one body takes all; the exponential must stay a number.
  constexpr double least = 1e-3, most = 1e3, greatest_exponent = 700;
  const double ratio = std::clamp(lower_hardness / upper_hardness, least, most);
  const double exponent = 1.5 * (ratio * ratio - 1 / (ratio * ratio));
  if (exponent > greatest_exponent) return 0;
  if (exponent < -greatest_exponent) return 1;
  return 1 / (1 + elementary::exp(exponent) * modulus_ratio);
}

void plan_plasticity(const PlasticityOptions& options, const ContactGeometry& geometry, Plan& plan) {
  PlannedYield yield;
  yield.hardening = options.hardening;
  yield.lower_hardness = hardness_of(lower_material(geometry.lower()), options.hardness, "lower");
  yield.upper_hardness = geometry.upper_is_flat()
                             ? never
                             : hardness_of(upper_material(geometry.upper()), options.hardness, "upper");
  const auto rigid = [](const Material* material) { return material != nullptr && material->rigid; };
  if (rigid(lower_material(geometry.lower())) &&
      (geometry.upper_is_flat() || rigid(upper_material(geometry.upper()))))
    throw Error(ErrorCode::bad_state, "the effect `plasticity` has no body that can yield",
                "a rigid body and a flat counter-body take no share: give a rough body a material with "
                "`hardness`, or leave the effect out");
  yield.modulus_ratio = modulus_ratio_of(geometry, plan);
  const bool alike =
      yield.lower_hardness == yield.upper_hardness && yield.modulus_ratio == 1 && !yield.hardens();
  if (std::isfinite(yield.lower_hardness) && std::isfinite(yield.upper_hardness) && !alike)
    laws_met().meet(Law::plastic_shares);
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
    // Measured on half-spaces: 45 transforms on 256 cells a side, 60 on 512 and 100 on 1024. Boxes have none.
    const double more =
        std::max(1.0, std::sqrt(std::sqrt(static_cast<double>(geometry.grid().nodes())) / 256.0));
    plan.transforms *= more;
    if (std::holds_alternative<HalfSpaceOperator>(plan.elasticity)) plan.seconds *= more;
  }
  plan.yield = yield;
}

LocalHardness local_hardness(const ContactGeometry& geometry, const PlannedYield& yield) {
  const HardnessMemory& memory = geometry.hardness();
  LocalHardness local;
  local.lower = memory.lower;
  if (memory.upper_here) {
    local.upper = memory.upper_here;
  } else if (memory.upper) {
    Field seen = geometry.pose().to_lower(*memory.upper, geometry.grid());
    // Where the turned upper body has no node it cannot be touched; it is as hard there as it began.
    for (double& value : seen.values())
      if (std::isnan(value)) value = yield.upper_hardness;
    local.upper = std::make_shared<const Field>(std::move(seen));
  }
  return local;
}

YieldLaw yield_law(const PlannedYield& yield, const LocalHardness& local, double factor) {
  YieldLaw law;
  if (!std::isfinite(yield.hardness())) return law;
  law.cap = factor * yield.hardness();
  if (!yield.hardens()) return law;
  law.hardening = yield.hardening;
  if (!local.lower && !local.upper) return law;
  Field limit = local.lower ? *local.lower : *local.upper;
  for (std::size_t k = 0; k < limit.size(); ++k)
    limit[k] = factor * std::min(local.lower ? (*local.lower)[k] : yield.lower_hardness,
                                 local.upper ? (*local.upper)[k] : yield.upper_hardness);
  law.yield = std::make_shared<const Field>(std::move(limit));
  return law;
}

YieldedBodies yielded_bodies(const ContactGeometry& geometry, const PlannedYield& yield,
                             const PlasticChange& change) {
  const Grid& grid = geometry.grid();
  const Field& w = change.approach;
  const bool hardens = !change.hardness.empty();
  const LocalHardness local = local_hardness(geometry, yield);
  const auto lower_share = [&](std::size_t k) {
    return lower_plastic_share(local.lower ? (*local.lower)[k] : yield.lower_hardness,
                               local.upper ? (*local.upper)[k] : yield.upper_hardness, yield.modulus_ratio);
  };

  Field lower = geometry.lower().heights();
  Field upper_loss(grid.nx, grid.ny);
  for (std::size_t k = 0; k < w.size(); ++k) {
    if (!(w[k] > 0)) continue;
    const double share = lower_share(k);
    lower[k] -= share * w[k];
    upper_loss[k] = (1 - share) * w[k];
  }

  YieldedBodies after{with_heights(geometry.lower(), std::move(lower)), geometry.upper(),
                      geometry.hardness()};
  const auto* rough = std::get_if<Surface>(&geometry.upper());
  if (rough != nullptr && std::isfinite(yield.upper_hardness)) {
    const Pose& pose = geometry.pose();
    Field own_loss = pose.to_upper(upper_loss, grid);
    if (!pose.on_lattice()) {
      const double meant = block_sum(upper_loss.values()), mapped = block_sum(own_loss.values());
      if (meant > 0 && mapped > 0) {
        after.mapped_volume = mapped / meant;
        for (double& loss : own_loss.values()) loss *= meant / mapped;
      }
    }
    Field upper = rough->heights();
    for (std::size_t k = 0; k < upper.size(); ++k)
      if (own_loss[k] > 0) upper[k] -= own_loss[k];
    after.upper = with_heights(*rough, std::move(upper));
  }
  if (hardens) {
    if (std::isfinite(yield.lower_hardness))
      after.hardness.lower = hardened(after.hardness.lower, yield.lower_hardness, change.hardness, grid);
    if (rough != nullptr && std::isfinite(yield.upper_hardness)) {
      after.hardness.upper = hardened(after.hardness.upper, yield.upper_hardness,
                                      geometry.pose().to_upper(change.hardness, grid), grid);
      if (!geometry.pose().on_lattice())
        after.hardness.upper_here = hardened(local.upper, yield.upper_hardness, change.hardness, grid);
    }
  }
  return after;
}

}  // namespace asperity
