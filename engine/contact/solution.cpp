// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/solution.hpp"

#include <numbers>

#include "engine/core/constants.hpp"

namespace asperity {

Array<std::uint8_t> Solution::contact_mask() const {
  const Field pressure = pressure_field();
  Array<std::uint8_t> mask(pressure.size());
  std::transform(pressure.values().begin(), pressure.values().end(), mask.begin(),
                 [](double p) { return static_cast<std::uint8_t>(p > 0); });
  return mask;
}

Field Solution::lower_under_load() const {
  return under_load(geometry().lower().heights(), plan().elasticity->lower_share, false);
}

Field Solution::upper_under_load() const {
  const Grid& grid = geometry().grid();
  const auto* rough = std::get_if<Surface>(&geometry().upper());
  return under_load(rough ? rough->heights() : Field(grid.nx, grid.ny), 1 - plan().elasticity->lower_share,
                    true);
}

Field Solution::under_load(const Field& before, double share, bool upper) const {
  Field z = before;
  if (share != 0) {
    Field u = displacement_field();
    if (upper) u = geometry().pose().to_upper(u, geometry().grid());
    for (std::size_t k = 0; k < z.size(); ++k) z[k] -= share * u[k];
  }
  if (upper && geometry().upper_is_flat()) return z;
  if (const std::optional<PlasticChange> change = plastic_change()) {
    const YieldedBodies after = yielded_bodies(geometry(), *plan().yield, *change);
    const Field& now = upper ? std::get<Surface>(after.upper).heights() : after.lower.heights();
    for (std::size_t k = 0; k < z.size(); ++k) z[k] -= before[k] - now[k];
  }
  return z;
}

namespace {
constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();

double farther(const NodeBracket& bracket, std::int64_t found) {
  return static_cast<double>(std::max({bracket.high - found, found - bracket.low, std::int64_t{0}}));
}

// Bound of a/b.
double of_quotient(double a, double error_a, double b, double error_b) {
  if (!(b > 0)) return error_b > 0 || error_a > 0 ? infinity : 0;
  if (!(error_b < b)) return infinity;
  return (error_a + (a / b) * error_b) / (b - error_b) + rounding * (a / b);
}
}  // namespace

AlgebraicError find_algebraic_error(const Solution& solution) {
  const CostScope scope;
  const SolutionError found = solution.error();
  const Solution::Numbers& numbers = solution.numbers();
  const ContactGeometry& bodies = solution.geometry();
  const Grid& grid = bodies.grid();
  const auto n = static_cast<double>(grid.nodes());

  AlgebraicError error;
  error.nodes = static_cast<std::int64_t>(grid.nodes());
  error.node_area = grid.cell_area();
  error.load = found.load;
  if (found.load) error.pressure = *found.load / grid.area() + rounding * numbers.pressure;
  error.approach = found.approach;
  const double height = bodies.peak_to_valley();
  error.indentation = height > 0 ? found.approach / height : infinity;
  error.separation = found.approach + rounding * height;
  if (found.plastic_volume > 0)
    error.separation += found.plastic_volume / (static_cast<double>(bodies.facing()) * error.node_area);
  error.mean_gap = found.mean_gap;
  error.energy = found.energy;
  error.peak_pressure = found.peak_pressure;
  if (error.pressure)
    error.secant_stiffness = of_quotient(numbers.pressure, *error.pressure, numbers.approach, found.approach);
  error.contact_bracket = found.contacts;
  error.contacts = farther(found.contacts, numbers.contacts);
  error.area = error.contacts * error.node_area;
  error.area_fraction = error.contacts / n;
  // One node changes up to four outline edges.
  constexpr double excess = (std::numbers::pi - 1 + std::numbers::ln2) / 24;
  error.corrected_area_fraction = static_cast<double>(found.may_differ) * (1 + 4 * excess) / n;
  if (solution.plan().yield) {
    error.plastic_volume = found.plastic_volume;
    error.plastic_fraction = farther(found.yielded, numbers.yielded) / n;
    error.yielded_bracket = found.yielded;
  }
  error.cost = scope.so_far();
  return error;
}

}  // namespace asperity
