// SPDX-License-Identifier: GPL-3.0-or-later
// Boundary of the tile.
#pragma once

#include <string_view>

namespace asperity {

// Periodic: regions, displacements and shifts wrap around the rim.
enum class Boundary { free, periodic };
std::string_view name(Boundary boundary);

}  // namespace asperity
