// SPDX-License-Identifier: GPL-3.0-or-later
// The hybrid parameters of a surface, ISO 25178-2: root mean square slope Sdq and developed area Sdr. The
// standard gives integrals and no differences, so the differences are part of the result:
//   edges    Sdq² = mean over edges along x of (dz/hx)² + mean over edges along y of (dz/hy)²
//   seven    the rule (-1, 9, -45, 0, 45, -9, 1)/(60 h) along both axes, where the whole cross was measured
//   Sdr      per cell the mean of its two splittings into triangles, over the cell's area, less 1: exactly 0
//   for a
//            flat map and √(1 + p² + q²) - 1 for a plane, with holes or without; about Sdq²/2 for small
//            slopes.
// Only edges, crosses and cells all of whose samples were measured count. Slopes of noise grow as noise/h:
// a number without its S-filter says little.
#pragma once

#include <cstddef>
#include <optional>

#include "engine/surface/surface.hpp"

namespace asperity {

struct ArealSlopes {
  std::optional<double> Sdq;        // over edges; none where no edge along either axis was measured
  std::optional<double> Sdq_seven;  // none where no cross was measured
  std::optional<double> Sdr;        // share, 0 … ; none where no cell was measured
  std::size_t cells = 0;            // cells of four measured corners
};

// One pass; takes a few numbers a row. The same bits for any number of threads. A surface one node wide has
// the slope along its length and no Sdr.
ArealSlopes areal_slopes(const Surface& surface);

}  // namespace asperity
