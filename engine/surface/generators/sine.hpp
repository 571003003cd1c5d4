// SPDX-License-Identifier: GPL-3.0-or-later
// z = A cos(2πx/λ), or z = A cos(2πx/λ) cos(2πy/λ); crest at node (0, 0). Contact: Westergaard (1939);
// Johnson, Greenwood and Higginson (1985).
#pragma once

#include <optional>

#include "engine/core/monitor.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

struct SineOptions {
  Grid grid;
  double amplitude = 0;              // m, >= 0
  std::optional<double> wavelength;  // m, λ; default the size along x
  int directions = 1;                // 1: along x; 2: product
};

// z(i, j) = A x[i] y[j]. Throws as sine_surface().
struct SineFactors {
  Array<double> x, y;
  double wavelength = 0;  // m
  bool periodic = false;  // whole waves in the tile
};
SineFactors sine_factors(const SineOptions& options);

// With whole wavelengths (to 1e-12), the surface is periodic and mirror-symmetric to the bit. O(nodes).
// Throws Error{bad_value} naming `amplitude`, `directions`, or `wavelength` below two cells.
Surface sine_surface(const SineOptions& options, Monitor& monitor = Monitor::silent());

}  // namespace asperity
