// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/solver/unconverged.hpp"

#include <algorithm>

#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

std::string unconverged_hint(const Grid& grid) {
  constexpr double much_longer = 4;
  const double aspect = std::max(grid.hx(), grid.hy()) / std::min(grid.hx(), grid.hy());
  if (aspect >= much_longer)
    return "the cells are " + format_short(aspect, 3) +
           " times longer than wide: ask for cells nearer to square, a larger `tolerance`, or accept the "
           "best "
           "reached with `on_failure = \"best\"`";
  return "ask for a larger `tolerance`, a finer grid for the same surface, or accept the best reached with "
         "`on_failure = \"best\"`";
}

void throw_unconverged(double mean_pressure, const Certificate& reached, double tolerance, int applications,
                       const Grid& grid) {
  throw Error(ErrorCode::not_converged,
              "the contact at " + format_quantity(mean_pressure, dimension::pressure) +
                  " reached a residual of " + format_short(reached.worst(), 3) +
                  " where `tolerance` asks for " + format_short(tolerance, 3) + ", after " +
                  std::to_string(applications) + " applications of the half-space",
              unconverged_hint(grid));
}

}  // namespace asperity
