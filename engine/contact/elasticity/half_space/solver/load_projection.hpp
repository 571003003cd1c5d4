// SPDX-License-Identifier: GPL-3.0-or-later
// The nearest pressures within their bounds that carry the load: p = clip(y + λ, 0, H), Σ p = load. λ is the
// root of a monotone, piecewise linear function (safeguarded Newton). Values at 0 and H are exact;
// optionally λ moves only some nodes. Also line loads of long cells. The displacement under a line along the
// short side depends almost only on the line's load: at aspect 100 an error of the line load moves the whole
// line 100 times further than the same error within the line. Settling clips single pressures, so each line
// is shifted back to its former load.
#pragma once

#include <cstdint>
#include <span>

#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"

namespace asperity {

// `target` may be `y`. `shift_where`: 1 for nodes that λ moves, empty for all. Σ p = load to a few ulps.
// Returns false, `target` untouched, if the marked nodes cannot carry the load. Requires 0 <= load <=
// upper·nodes.
bool project_to_load(std::span<const double> y, std::span<const std::uint8_t> shift_where, double upper,
                     double load, std::span<double> target);

// Whether cells are long enough (either way) that settling must preserve line loads.
bool keeps_line_loads(double aspect);

// Shifts and clips the nodes of each line with `where` != 0 until the line carries its load in `before`, if
// possible. `settled` is within 0 … upper. O(n).
void keep_line_loads(const LevelShape& shape, std::span<const double> before,
                     std::span<const std::uint8_t> where, double upper, std::span<double> settled);

}  // namespace asperity
