// SPDX-License-Identifier: GPL-3.0-or-later
// What lies beyond the rim of the tile: nothing, or the same tile again and again.
#pragma once

#include <string_view>

namespace asperity {

// Whether contact regions, displacements and shifts go round the rim of the tile.
enum class Boundary { free, periodic };
std::string_view name(Boundary boundary);

}  // namespace asperity
