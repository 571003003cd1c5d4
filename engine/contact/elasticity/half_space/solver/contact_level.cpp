// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace asperity {

namespace {
// Of wave number π/2 over the root of the cell's sides.
double stiffness_of_short_waves(const LevelShape& shape) {
  const double of_half_space = std::numbers::pi / 4 / std::sqrt(shape.aspect);
  return shape.multiplier.shares() ? of_half_space / shape.multiplier.share(2 * of_half_space)
                                   : of_half_space;
}

double compliance_of_long_waves(const LevelShape& shape) {
  const double longest = std::max(static_cast<double>(shape.nx), shape.ny * shape.aspect);
  return shape.multiplier.shares() ? shape.multiplier.greatest_from(2 * std::numbers::pi / longest)
                                   : longest / std::numbers::pi;
}

// Of the preconditioner. With four, one random scene in 2000 of ground that hardens weakly stalled.
int sweeps_under(const PressureLimit& limit) {
  return std::holds_alternative<LinearHardening>(limit) ? 8 : 4;
}
}  // namespace

ContactLevel::ContactLevel(const LevelShape& level_shape, std::span<const double> raw_heights,
                           double height_origin, double height_factor, PressureLimit pressure_limit,
                           double mean)
    : shape(level_shape),
      limit(std::move(pressure_limit)),
      mean_pressure(mean),
      compliance(shape.nx, shape.ny, shape.aspect, shape.boundary, shape.weight, shape.single,
                 shape.multiplier),
      preconditioner(shape.nx, shape.ny, shape.aspect, shape.boundary, shape.weight, sweeps_under(limit),
                     shape.multiplier),
      short_wave_stiffness(stiffness_of_short_waves(shape)),
      greatest_compliance(compliance_of_long_waves(shape)),
      heights_(raw_heights),
      origin_(height_origin),
      factor_(height_factor),
      unit_(mean > 0 && std::isfinite(mean) ? std::ldexp(1.0, std::ilogb(mean)) : 1) {
  compliance.count_pressures_in(unit_);
}

void ContactLevel::unpressed_gap(std::size_t first, std::size_t n, double* g) const {
  for_stretch(0, n, [=, h = heights_.data() + first, origin = origin_, factor = factor_](std::size_t k) {
    g[k] = (origin - h[k]) * factor;
  });
}

void ContactLevel::gap(std::span<const double> p, std::span<double> g) {
  gap_beside(p, immobile_pressure(), g);
}

void ContactLevel::gap_beside_mean(std::span<const double> p, std::span<double> g) { gap_beside(p, 0, g); }

void ContactLevel::gap_beside(std::span<const double> p, double mean, std::span<double> g) {
  ++applications;
  const auto nx = static_cast<std::size_t>(shape.nx);
  const auto source = [=](int j, double* row) -> const double* {
    const std::size_t begin = static_cast<std::size_t>(j) * nx;
    for_stretch(0, nx, [=, from = p.data() + begin](std::size_t k) { row[k] = from[k] - mean; });
    return row;
  };
  const auto sink = [=, h = heights_.data(), origin = origin_, factor = factor_](int j, const double* row) {
    const std::size_t begin = static_cast<std::size_t>(j) * nx;
    for_stretch(0, nx, [=, h = h + begin, to = g.data() + begin](std::size_t k) {
      to[k] = row[k] - (h[k] - origin) * factor;
    });
  };
  compliance.apply_in_double(source, sink, g);
}

}  // namespace asperity
