// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/unconverged.hpp"

#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

void throw_unconverged(double mean_pressure, const Certificate& reached, double tolerance, int applications) {
  throw Error(ErrorCode::not_converged,
              "the contact at " + format_quantity(mean_pressure, dimension::pressure) +
                  " reached a residual of " + format_short(reached.worst(), 3) +
                  " where `tolerance` asks for " + format_short(tolerance, 3) + ", after " +
                  std::to_string(applications) + " applications of the half-space",
              "ask for a larger `tolerance`, a finer grid for the same surface, or accept the best reached "
              "with `on_failure = \"best\"`");
}

}  // namespace asperity
