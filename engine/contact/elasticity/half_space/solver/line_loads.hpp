// SPDX-License-Identifier: GPL-3.0-or-later
// What the lines of cells much longer than wide carry. The displacement under a line along the short side
// follows from its load alone, but for what is small beside that: on cells a hundred times longer than wide
// an error in the load of a line moves all of it by a hundred times what the same error within the line does.
// Settling, which clips single pressures to their bounds, would make such errors in every pass; so each line
// is brought back to the load it had by a shift of the pressures that are free to move.
#pragma once

#include <cstdint>
#include <span>

#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"

namespace asperity {

// Cells so much longer than wide, or wider than long, that settling keeps the loads of lines.
bool keeps_line_loads(double aspect);

// `settled`, within 0 … upper, of pressures `before`: on each line the nodes where `where` is not 0 are
// shifted, and clipped to the bounds, until the line carries what it did before, as nearly as they can. O(n).
void keep_line_loads(const LevelShape& shape, std::span<const double> before,
                     std::span<const std::uint8_t> where, double upper, std::span<double> settled);

}  // namespace asperity
