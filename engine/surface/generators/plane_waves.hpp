// SPDX-License-Identifier: GPL-3.0-or-later
// w(i, j) = Σ a cos(2π(sx·i + sy·j)/2⁶⁴ + φ) on a grid, as a matrix product nx × 2K by 2K × ny of cosines
// and sines. Mirror images in x or y share columns, which halves K for evenly spread directions; a wave
// along an axis costs a vector. No transform: the waves need not fit the grid.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "engine/core/grid.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

struct PlaneWave {
  std::uint64_t step_x = 0, step_y = 0;  // turns per grid step, in 2⁻⁶⁴
  double amplitude = 0;                  // unit of the heights
  double phase = 0;                      // rad
};

// Preconditions: 1 <= nx, ny <= max_cells, finite amplitudes and phases. Error of a value: about 4e-16 · √K
// times the root sum of squares of the amplitudes. Cost: 4·nx·ny·K flops, K waves after mirroring. Memory:
// the field, under 100 bytes a wave, tables of 32 MiB at most for nx + ny <= 65536 (64 MiB beyond). Same
// bits for any number of threads: tiles and order are fixed. `what` names the progress.
Field sum_of_plane_waves(int nx, int ny, std::span<const PlaneWave> waves, Monitor& monitor,
                         std::string_view what);

}  // namespace asperity
