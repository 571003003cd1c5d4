// SPDX-License-Identifier: GPL-3.0-or-later
// Periodic Gaussian self-affine surface: plane waves with independent complex normal amplitudes. Power is
// flat from q_L = 2π/long_wave (included) to q_r = 2π/roll_off, falls as |q|^(-2-2H) to q_s = 2π/short_wave
// (excluded), and is zero elsewhere (Persson et al. 2005, J. Phys.: Condens. Matter 17 R1). Amplitudes
// depend only on seed and wave numbers, so a finer grid samples the same surface.
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
  std::optional<double> rms_height;  // m, population rms of the nodes
  std::optional<double> rms_slope;   // √(Σ |q|² |z_q|²), spectral
  std::optional<double> ra;          // m, mean absolute height
  std::optional<double> long_wave;   // m; default the longer side
  std::optional<double> roll_off;    // m; default long_wave
  double short_wave = 0;             // m, at least two cells
  std::uint64_t seed = 1;
};

// The requested measure is exact; the mean is zero. rms_height and rms_slope scale by sums over waves, so
// shared nodes of two grids agree to rounding. ra scales by the nodes, with their sampling error; the
// recipe fixes this scale. O(n log n), 16 bytes a node. Same bits for any number of threads. Throws
// Error{bad_value} naming an option out of range.
Surface self_affine_surface(const SelfAffineOptions& options, Monitor& monitor = Monitor::silent());

// Throws as self_affine_surface().
void require_makeable(const SelfAffineOptions& options);

}  // namespace asperity
