// SPDX-License-Identifier: GPL-3.0-or-later
// Bead-blasted surface, after Hanaor, Gan & Einav (2013): random dents in sequence, plus a fine self-affine
// texture. A dent of radius a from a bead of radius R has the floor
//
//   z(r) = mean of the surface within a + (r² - a²)/2R    where lower and r² < 2.2 a²
//
// Half of the removed volume forms a Gaussian rim, exp(-((r - 1.15a)/0.2a)²). A possible step at r² = 2.2 a²
// makes node slopes grow with the number of cells. Not modelled: bead speed, hardening, oblique impact.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/core/monitor.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

struct BlastTexture {
  double hurst = 0.8;         // H, in (0, 1]
  double roll_off = 40e-6;    // m, flat above, up to the longer side
  double short_wave = 16e-6;  // m, at least two cells
  double share = 0.12;        // Ra of the texture, relative to `ra`
};

struct BeadBlastedOptions {
  Grid grid;
  double ra = 0;                                      // m, mean absolute deviation
  double bead_low = 250e-6, bead_high = 300e-6;       // m, diameters, uniform
  double dent_low = 25e-6, dent_high = 60e-6;         // m, radii, uniform
  double coverage = 4;                                // area of all dents / area of the tile
  std::optional<BlastTexture> fine = BlastTexture{};  // none: smooth dents
  std::uint64_t seed = 1;
};

inline constexpr double most_dents = 1e7;

// coverage · area / (π · mean radius²), rounded, at least 1.
double dent_count(const BeadBlastedOptions& options);

// Periodic. Ra is exact on the nodes; the mean is zero. Dent k depends only on seed and k: a finer grid
// resolves the same surface, up to the sampling error of sums over nodes. The recipe reuses the scales of the
// first grid. About 6 · coverage visits per node, plus one self-affine surface; two fields. Throws
// Error{bad_value} naming an option out of range, for a dent wider than its bead, and for cells longer than
// the smallest dent's radius.
Surface bead_blasted_surface(const BeadBlastedOptions& options, Monitor& monitor = Monitor::silent());

// Throws as bead_blasted_surface().
void require_makeable(const BeadBlastedOptions& options);

}  // namespace asperity
