// SPDX-License-Identifier: GPL-3.0-or-later
// A periodic Gaussian self-affine surface: a sum of plane waves with independent complex normal
// amplitudes whose power is flat from q_L = 2π/long_wave to q_r = 2π/roll_off, falls as |q|^(-2-2H)
// to q_s = 2π/short_wave, and is zero elsewhere (Persson et al. 2005, J. Phys.: Condens. Matter 17
// R1). Waves of |q| = q_L are in, those of |q| = q_s are out. The amplitude of a wave is drawn from
// the seed and its integer wave numbers alone, so a finer grid samples the same surface.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/core/monitor.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

struct SelfAffineOptions {
  Grid grid;
  double hurst = 0;  // H, in (0, 1]
  // Exactly one of the three.
  std::optional<double> rms_height;  // m, population rms of the heights of the nodes
  std::optional<double> rms_slope;   // √(Σ |q|² |z_q|²), the spectral slope
  std::optional<double> ra;          // m, mean absolute height of the nodes
  std::optional<double> long_wave;   // m; default the longer side
  std::optional<double> roll_off;    // m; default long_wave
  double short_wave = 0;             // m, at least two cells
  std::uint64_t seed = 1;
};

// The requested height or slope is met exactly, to rounding, and the mean is zero. rms_height and
// rms_slope scale by sums over the waves, so the nodes that two grids share agree to rounding; ra is
// met on the nodes of this grid, and its scale moves with the grid by about the sampling error of Ra. Made
// again on other cells it keeps the scale it has here, so that shared nodes agree to rounding for all three.
// O(n log n) in the nodes; holds one spectrum and one field, 16 bytes a node. Same bits for any
// number of threads. Throws Error{bad_value} naming the option that is out of range.
Surface self_affine_surface(const SelfAffineOptions& options, Monitor& monitor = Monitor::silent());

// Throws as self_affine_surface for an option out of range; makes nothing.
void require_makeable(const SelfAffineOptions& options);

}  // namespace asperity
