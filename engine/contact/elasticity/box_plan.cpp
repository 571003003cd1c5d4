// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/box_plan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/contact/elasticity/sorted_drops.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

// (1−ν²)/E, 1/Pa; nothing when the material does not say.
std::optional<double> compliance(const Material* material) {
  if (material == nullptr) return {};
  if (!material->rigid && !(material->young && material->poisson)) return {};
  return 1.0 / plane_strain_modulus(*material);
}

double compliance_needed(const Material* material, const std::string& body, bool is_flat) {
  const std::string wants = "box elements need `young` and `poisson` of the " + body +
                            " body to set their stiffness (effect `elasticity`)";
  if (material == nullptr)
    throw Error(ErrorCode::bad_state, wants + ", which has no material",
                "give `material=` to the surface, or `stiffness` to the box elements");
  if (const std::optional<double> known = compliance(material)) return *known;
  const std::string called = material->name.empty() ? std::string("its material") : quoted(material->name);
  throw Error(ErrorCode::bad_state,
              wants + "; " + called + " has no " + quoted(material->young ? "poisson" : "young"),
              std::string("give it in lab.material{...}, or `stiffness` to the box elements") +
                  (is_flat ? ", or press with lab.rigid" : ""));
}

double default_modulus(const ContactGeometry& geometry) {
  const double sum = compliance_needed(lower_material(geometry.lower()), "lower", false) +
                     compliance_needed(upper_material(geometry.upper()), "upper", geometry.upper_is_flat());
  if (!(sum > 0))
    throw Error(ErrorCode::bad_state,
                "both bodies are rigid, so box elements have no modulus (effect `elasticity`)",
                "give one body an elastic material, or `stiffness` to the box elements");
  return 1.0 / sum;
}

double lower_share(const ContactGeometry& geometry) {
  const auto lower = compliance(lower_material(geometry.lower()));
  const auto upper = compliance(upper_material(geometry.upper()));
  if (upper && *upper == 0) return 1;
  if (lower && *lower == 0) return 0;
  if (lower && upper) return *lower / (*lower + *upper);
  return geometry.upper_is_flat() ? 1 : 0.5;
}

}  // namespace

void plan_box(const BoxOptions& options, const ContactGeometry& geometry, Plan& plan) {
  const double height = geometry.peak_to_valley();
  BoxOperator box;
  std::string origin;
  if (options.stiffness) {
    box.stiffness = *options.stiffness;
    origin = "as given";
    // A plane of heights has no peak-to-valley: a cell is the only length left.
    const Grid& grid = geometry.grid();
    box.reference_pressure = box.stiffness * (height > 0 ? height : std::min(grid.hx(), grid.hy()));
  } else {
    const double modulus = default_modulus(geometry);
    if (!(height > 0))
      throw Error(ErrorCode::bad_value,
                  "all combined heights are equal, so E*/peak-to-valley gives box elements no stiffness",
                  "give `stiffness` in Pa/m");
    box.stiffness = modulus / height;
    box.reference_pressure = modulus;
    origin = "E*/peak-to-valley, " + format_quantity(modulus, dimension::pressure) + " / " +
             format_quantity(height, dimension::length);
  }
  if (!std::isfinite(box.stiffness) || !std::isfinite(box.reference_pressure) || !(box.stiffness > 0))
    throw Error(ErrorCode::bad_value,
                "the stiffness of the box elements comes to " + format_short(box.stiffness) + " Pa/m",
                "check the units of the heights and of `young`, or give `stiffness`");
  box.lower_share = lower_share(geometry);

  const std::size_t nodes = geometry.grid().nodes();
  constexpr double seconds_per_node = 4e-8;  // of sorting, measured on one core
  plan.elasticity = box;
  plan.solver = "closed form (sorted heights)";
  plan.terms.push_back({"elasticity", "box elements, stiffness " +
                                          format_quantity(box.stiffness, dimension::stiffness) + " (" +
                                          origin + ")"});
  plan.buffers.push_back({"sorted heights and their sums", SortedDrops::bytes(nodes)});
  plan.buffers.push_back(
      {"while sorting",
       SortedDrops::bytes_while_sorting(nodes) - static_cast<std::int64_t>(nodes * sizeof(double)), false});
  plan.seconds = std::max(1e-6, seconds_per_node * static_cast<double>(nodes));
}

}  // namespace asperity
