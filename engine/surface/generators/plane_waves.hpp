// SPDX-License-Identifier: GPL-3.0-or-later
// The sum of many plane waves on a grid, w(i, j) = Σ a cos(2π(sx·i + sy·j)/2⁶⁴ + φ), as a matrix
// product. Each wave separates into cosines and sines of x and of y, so the whole grid is one
// product of nx × 2K by 2K × ny numbers. Two waves that are mirror images in x (or in y) stand on
// the same columns and are added there, which halves K for directions spread evenly; a wave along
// an axis costs a vector only. No transform is used: the waves need not fit the grid.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "engine/core/grid.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

struct PlaneWave {
  std::uint64_t step_x = 0, step_y = 0;  // turns per grid step in x and y, in 2⁻⁶⁴
  double amplitude = 0;                  // any unit; heights come in the same
  double phase = 0;                      // rad
};

// Preconditions: 1 <= nx, ny <= max_cells, finite amplitudes and phases; no waves give zeros.
// Error of a value: about 4e-16 of the root sum of squares of the amplitudes times √K.
// Cost: 4·nx·ny·K flops with K the waves left after mirroring. Memory: the field, under 100 bytes a wave,
// and tables of 32 MiB at most while nx + ny <= 65536 (64 MiB beyond).
// The same bits for any number of threads: tiles and order are fixed by nx, ny and the waves, and
// each tile's product is single-threaded. Progress goes out under the name `what`.
Field sum_of_plane_waves(int nx, int ny, std::span<const PlaneWave> waves, Monitor& monitor,
                         std::string_view what);

}  // namespace asperity
