// SPDX-License-Identifier: GPL-3.0-or-later
// The nearest pressures that respect their bounds and carry the load: p = clip(y + λ, 0, H), Σ p = load,
// with λ the root of a monotone, piecewise linear function, found by safeguarded Newton steps. Values
// at 0 and H stay exactly there. Also restricted to some nodes, the others only clipped.
// And the loads of lines of cells much longer than wide. The displacement under a line along the short side
// follows from its load alone, but for what is small beside that: on cells a hundred times longer than wide
// an error in the load of a line moves all of it by a hundred times what the same error within the line does.
// Settling, which clips single pressures to their bounds, would make such errors in every pass; so each line
// is brought back to the load it had by a shift of the pressures that are free to move.
#pragma once

#include <cstdint>
#include <span>

#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"

namespace asperity {

// `target` may be `y`. `shift_where`: nodes that λ moves (1), or empty for all. Σ p = load to a few ulps of
// the sum. Returns false, `target` untouched, where the marked nodes cannot carry the load between the
// bounds. Precondition: 0 <= load <= upper·nodes for the whole grid.
bool project_to_load(std::span<const double> y, std::span<const std::uint8_t> shift_where, double upper,
                     double load, std::span<double> target);

// Cells so much longer than wide, or wider than long, that settling keeps the loads of lines.
bool keeps_line_loads(double aspect);

// `settled`, within 0 … upper, of pressures `before`: on each line the nodes where `where` is not 0 are
// shifted, and clipped to the bounds, until the line carries what it did before, as nearly as they can. O(n).
void keep_line_loads(const LevelShape& shape, std::span<const double> before,
                     std::span<const std::uint8_t> where, double upper, std::span<double> settled);

}  // namespace asperity
