// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest pressures within their bounds that carry the load: p = clip(y + λ, 0, H), Σ p = load, by
// safeguarded Newton steps for λ; optionally λ moves only some nodes. Also line loads of long cells: at
// aspect 100 an error of the load of a line (along the short side) moves the line 100 times further than an
// error within it. Settling clips single pressures, so each line is shifted back to its former load.
#pragma once

#include <cstdint>
#include <span>

#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"

namespace asperity {

// `target` may be `y`. `shift_where`: 1 for nodes that λ moves, empty for all. Values at 0 and H are exact,
// Σ p = load to a few ulps. Returns false, `target` untouched, if the marked nodes cannot carry the load.
// Requires 0 <= load <= upper·nodes.
bool project_to_load(std::span<const double> y, std::span<const std::uint8_t> shift_where, double upper,
                     double load, std::span<double> target);

// Cells much longer than wide, or the other way.
bool keeps_line_loads(double aspect);

// Shifts and clips nodes with `where` != 0 until each line carries its load in `before`, if possible.
// `settled` is within 0 … upper. O(n).
void keep_line_loads(const LevelShape& shape, std::span<const double> before,
                     std::span<const std::uint8_t> where, double upper, std::span<double> settled);

}  // namespace asperity
