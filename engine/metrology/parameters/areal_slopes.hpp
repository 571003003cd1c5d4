// SPDX-License-Identifier: GPL-3.0-or-later
// Root mean square slope Sdq and developed area Sdr (ISO 25178-2). The standard leaves the differences open:
//   edges  Sdq² = mean (dz/hx)² over edges along x + mean (dz/hy)² along y
//   seven  (-1, 9, -45, 0, 45, -9, 1)/(60 h) along both axes
//   Sdr    mean area of a cell's two triangulations over its projection, minus 1; a plane: √(1 + p² + q²) - 1
// Only fully measured edges, crosses and cells count. Noise adds slopes of noise/h; apply an S-filter.
#pragma once

#include <cstddef>
#include <optional>

#include "engine/surface/surface.hpp"

namespace asperity {

struct ArealSlopes {
  std::optional<double> Sdq;        // over edges; empty without edges
  std::optional<double> Sdq_seven;  // empty without crosses
  std::optional<double> Sdr;        // share >= 0; empty without cells
  std::size_t cells = 0;            // with four measured corners
};

// One pass; same bits for any thread count. One node wide: no Sdr.
ArealSlopes areal_slopes(const Surface& surface);

}  // namespace asperity
