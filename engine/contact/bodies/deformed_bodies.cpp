// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/bodies/deformed_bodies.hpp"

#include "engine/contact/planned_yield.hpp"

namespace asperity {

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
