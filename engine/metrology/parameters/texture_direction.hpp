// SPDX-License-Identifier: GPL-3.0-or-later
// The direction of a texture, Std of ISO 25178-2: the angle at which the power of the waves is greatest, in
// bins of half a degree. Heights about their mean, holes at the mean, a Hann window, frequencies in cycles a
// metre, those of more than 1.5 cycles along the map and below the smaller of the two Nyquist frequencies.
// That is the direction of the wave vector, at right angles to the lay; both are given. Resolution is about
// 57°/(cycles in the map); where the texture has no direction (Str near 1) the number means nothing.
#pragma once

#include "engine/surface/surface.hpp"

namespace asperity {

struct TextureDirection {
  double wave = 0;  // rad from x towards y, 0 … π: of the wave vector
  double lay = 0;   // rad, 0 … π: wave ± π/2
  double share =
      0;  // of the power that counts, the part within the one bin; 1/360 where there is no direction
};

// One transform, two copies of the grid. Throws Error{bad_value} for equal heights, for a map under six of
// its longer cells along a side, and where no wave lies in the band.
TextureDirection texture_direction(const Surface& surface);

}  // namespace asperity
