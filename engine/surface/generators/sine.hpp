// SPDX-License-Identifier: GPL-3.0-or-later
// A cosine wave, z = A cos(2πx/λ), or the product of two, z = A cos(2πx/λ) cos(2πy/λ), with a crest
// of height A at node (0, 0). The surfaces of Westergaard (1939) and of Johnson, Greenwood and
// Higginson (1985), for which contact has known answers.
#pragma once

#include <optional>

#include "engine/core/monitor.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

struct SineOptions {
  Grid grid;
  double amplitude = 0;              // m, A >= 0
  std::optional<double> wavelength;  // m, λ; default the size along x
  int directions = 1;                // 1: along x only; 2: the product
};

// z(i, j) = A x[i] y[j]. Throws as sine_surface.
struct SineFactors {
  Array<double> x, y;
  double wavelength = 0;  // m
  bool periodic = false;  // whole waves in the tile
};
SineFactors sine_factors(const SineOptions& options);

// The phase is reduced exactly when the size is a whole number of wavelengths (to 1e-12), and the
// surface is then marked periodic and mirror-symmetric to the bit. O(nodes), of which only nx + ny
// evaluate a cosine. Throws Error{bad_value} naming `amplitude`, `directions`, or `wavelength` when a
// wave is shorter than two cells in a direction in which it varies.
Surface sine_surface(const SineOptions& options, Monitor& monitor = Monitor::silent());

}  // namespace asperity
