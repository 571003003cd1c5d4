// SPDX-License-Identifier: GPL-3.0-or-later
// A periodic surface blasted with beads, after the specimens of the source paper (Hanaor, Gan & Einav
// 2013: aluminium blasted with glass beads of 250–300 µm): dents at random places, one after the other,
// each on the ground that the earlier ones left, and a fine self-affine texture on top. A dent of radius
// a made by a bead of radius R has the floor
//
//   z(r) = mean of the ground within a + (r² - a²)/2R      where that is lower and r² < 2.2 a²
//
// and half of the volume it takes away rises around it as a Gaussian rim, exp(-((r - 1.15a)/0.2a)²).
// Ground that stands above the floor at r² = 2.2 a² is left there as a step, so the slope of single nodes
// grows with the number of cells; Ra does not. Not modelled: the speed of the beads, hardening of the ground,
// oblique hits.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/core/monitor.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// The self-affine texture left between and inside the dents.
struct BlastTexture {
  double hurst = 0.8;         // H, in (0, 1]
  double roll_off = 40e-6;    // m, wave above which its spectrum is flat, up to the longer side
  double short_wave = 16e-6;  // m, shortest wave, at least two cells
  double share = 0.12;        // its Ra as a fraction of the Ra of the surface
};

struct BeadBlastedOptions {
  Grid grid;
  double ra = 0;                                      // m, mean absolute deviation from the mean
  double bead_low = 250e-6, bead_high = 300e-6;       // m, diameters of the beads, uniform between the two
  double dent_low = 25e-6, dent_high = 60e-6;         // m, radii of the dents, uniform between the two
  double coverage = 4;                                // area of all dents over that of the tile
  std::optional<BlastTexture> fine = BlastTexture{};  // none: smooth dents
  std::uint64_t seed = 1;
};

inline constexpr double most_dents = 1e7;

// Number of dents: coverage · area / (π · mean radius²), rounded, at least 1.
double dent_count(const BeadBlastedOptions& options);

// Ra is met exactly on the nodes, to rounding, and the mean is zero. Place, radius and bead of dent k are
// drawn from the seed and k alone, the texture from its waves: a finer grid is the same surface better
// resolved, up to the sampling error of the sums over nodes (ground under a dent, volumes, Ra). Made again on
// other cells it keeps the scales that Ra and the texture have here. Cost about 25
// node visits per node and unit of coverage / 4, then one self-affine surface; two fields at the peak.
// Same bits for any number of threads. Throws Error{bad_value} naming the option that is out of range, a
// dent wider than its bead, or cells longer than the smallest dent's radius.
Surface bead_blasted_surface(const BeadBlastedOptions& options, Monitor& monitor = Monitor::silent());

// Throws as bead_blasted_surface for an option out of range; makes nothing.
void require_makeable(const BeadBlastedOptions& options);

}  // namespace asperity
