// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/contact_level.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace asperity {

ContactLevel::ContactLevel(const LevelShape& level_shape, std::span<const double> raw_heights,
                           double height_origin, double height_factor, PressureLimit pressure_limit,
                           double mean)
    : shape(level_shape),
      limit(std::move(pressure_limit)),
      mean_pressure(mean),
      compliance(shape.nx, shape.ny, shape.aspect, shape.boundary, shape.weight, shape.single),
      preconditioner(shape.nx, shape.ny, shape.aspect, shape.boundary, shape.weight,
                     std::holds_alternative<LinearHardening>(limit) ? 8 : 4),
      short_wave_stiffness(std::numbers::pi / 4 / std::sqrt(shape.aspect)),
      heights_(raw_heights),
      origin_(height_origin),
      factor_(height_factor),
      unit_(mean > 0 && std::isfinite(mean) ? std::ldexp(1.0, std::ilogb(mean)) : 1) {
  compliance.count_pressures_in(unit_);
}

void ContactLevel::gap(std::span<const double> p, std::span<double> g) {
  ++applications;
  // On a periodic tile the mean moves nothing, and may be so large that beside it the others lose digits.
  const double mean = shape.boundary == Boundary::periodic ? mean_pressure : 0;
  for_nodes(nodes(), [to = g.data(), from = p.data(), mean](std::size_t k) { to[k] = from[k] - mean; });
  compliance.apply_in_double(g, g);
  for_nodes(nodes(), [to = g.data(), h = heights_.data(), origin = origin_, factor = factor_](std::size_t k) {
    to[k] -= (h[k] - origin) * factor;
  });
}

}  // namespace asperity
