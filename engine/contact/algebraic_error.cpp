// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/algebraic_error.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "engine/contact/solution.hpp"
#include "engine/core/constants.hpp"

namespace asperity {

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

AlgebraicError find_algebraic_error(const Solution& solution, bool plastic) {
  const CostScope scope;
  const SolutionError found = solution.error();
  const ContactGeometry& bodies = solution.geometry();
  const Grid& grid = bodies.grid();
  const auto n = static_cast<double>(grid.nodes());

  AlgebraicError error;
  error.nodes = static_cast<std::int64_t>(grid.nodes());
  error.node_area = grid.cell_area();
  error.load = found.load;
  if (found.load) error.pressure = *found.load / grid.area() + rounding * solution.pressure();
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
    error.secant_stiffness =
        of_quotient(solution.pressure(), *error.pressure, solution.approach(), found.approach);
  error.contact_bracket = found.contacts;
  error.contacts = farther(found.contacts, solution.contacts());
  error.area = error.contacts * error.node_area;
  error.area_fraction = error.contacts / n;
  // Changing a node changes up to four edges of the outline.
  constexpr double excess = (std::numbers::pi - 1 + std::numbers::ln2) / 24;
  error.corrected_area_fraction = static_cast<double>(found.may_differ) * (1 + 4 * excess) / n;
  if (plastic) {
    error.plastic_volume = found.plastic_volume;
    error.plastic_fraction = farther(found.yielded, solution.yielded()) / n;
    error.yielded_bracket = found.yielded;
  }
  error.cost = scope.so_far();
  return error;
}

}  // namespace asperity
