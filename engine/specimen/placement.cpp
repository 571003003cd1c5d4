// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/specimen/placement.hpp"

#include "engine/core/arithmetic/random.hpp"

namespace asperity {

LatticeIsometry draw_placement(const Grid& grid, Boundary boundary, std::uint64_t seed) {
  const Stream stream(seed, "placement");
  const bool square = grid.nx == grid.ny && grid.size_x == grid.size_y;
  const auto quarters = static_cast<int>(square ? stream.below(0, 4) : 2 * stream.below(0, 2));
  const LatticeIsometry turned = LatticeIsometry(grid.nx, grid.ny).turned(quarters);
  if (boundary == Boundary::free) return turned;
  return turned.shifted(static_cast<int>(stream.below(1, static_cast<std::uint64_t>(grid.nx))),
                        static_cast<int>(stream.below(2, static_cast<std::uint64_t>(grid.ny))));
}

}  // namespace asperity
