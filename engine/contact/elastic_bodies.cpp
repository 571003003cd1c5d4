// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elastic_bodies.hpp"

#include <optional>

#include "engine/contact/planned_yield.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

// (1−ν²)/E, 1/Pa; none if the material lacks moduli.
std::optional<double> compliance(const Material* material) {
  if (material == nullptr) return {};
  if (!material->rigid && !(material->young && material->poisson)) return {};
  return 1.0 / plane_strain_modulus(*material);
}

}  // namespace

double contact_modulus(const ContactGeometry& geometry, const std::string& needs, const std::string& purpose,
                       const std::string& otherwise) {
  const std::string also = otherwise.empty() ? "" : ", or " + otherwise;
  const auto needed = [&](const Material* material, const std::string& body, bool is_flat) {
    const std::string wants = needs + " of the " + body + " body" + (purpose.empty() ? "" : " " + purpose) +
                              " (effect `elasticity`)";
    if (material == nullptr)
      throw Error(ErrorCode::bad_state, wants + ", which has no material",
                  "give `material=` to the surface" + also);
    if (const std::optional<double> known = compliance(material)) return *known;
    const std::string called = material->name.empty() ? std::string("its material") : quoted(material->name);
    throw Error(ErrorCode::bad_state,
                wants + "; " + called + " has no " + quoted(material->young ? "poisson" : "young"),
                "give it in lab.material{...}" + also + (is_flat ? ", or press with lab.rigid" : ""));
  };
  const double sum = needed(lower_material(geometry.lower()), "lower", false) +
                     needed(upper_material(geometry.upper()), "upper", geometry.upper_is_flat());
  if (!(sum > 0))
    throw Error(ErrorCode::bad_state,
                "both bodies are rigid, so there is no contact modulus E* (effect `elasticity`)",
                "give one body an elastic material" + also);
  return 1.0 / sum;
}

double lower_elastic_share(const ContactGeometry& geometry) {
  const auto lower = compliance(lower_material(geometry.lower()));
  const auto upper = compliance(upper_material(geometry.upper()));
  if (upper && *upper == 0) return 1;
  if (lower && *lower == 0) return 0;
  if (lower && upper) return *lower / (*lower + *upper);
  return geometry.upper_is_flat() ? 1 : 0.5;
}

Field lower_heights(const ContactGeometry& geometry, const std::optional<PlannedYield>& yield,
                    const Deformation& deformation) {
  Field z = geometry.lower().heights();
  if (const double share = deformation.lower_share; share != 0)
    for (std::size_t k = 0; k < z.size(); ++k) z[k] -= share * deformation.displacement[k];
  if (deformation.change) {
    const YieldedBodies after = yielded_bodies(geometry, *yield, *deformation.change);
    const Field& before = geometry.lower().heights();
    for (std::size_t k = 0; k < z.size(); ++k) z[k] -= before[k] - after.lower.heights()[k];
  }
  return z;
}

Field upper_heights(const ContactGeometry& geometry, const std::optional<PlannedYield>& yield,
                    const Deformation& deformation) {
  const Grid& grid = geometry.grid();
  const auto* rough = std::get_if<Surface>(&geometry.upper());
  Field z = rough ? rough->heights() : Field(grid.nx, grid.ny);
  if (const double share = 1 - deformation.lower_share; share != 0) {
    const Field own = geometry.pose().to_upper(deformation.displacement, grid);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] -= share * own[k];
  }
  if (deformation.change && rough) {
    const YieldedBodies after = yielded_bodies(geometry, *yield, *deformation.change);
    const Field& now = std::get<Surface>(after.upper).heights();
    for (std::size_t k = 0; k < z.size(); ++k) z[k] -= rough->heights()[k] - now[k];
  }
  return z;
}

}  // namespace asperity
