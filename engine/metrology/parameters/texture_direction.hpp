// SPDX-License-Identifier: GPL-3.0-or-later
// Texture direction Std of ISO 25178-2: the angle of maximum wave power, in half degrees. Mean in holes; Hann
// window; waves of over 1.5 cycles per map, below the smaller Nyquist frequency. Std is the wave vector,
// normal to the lay. Resolution about 57°/(cycles in the map); meaningless for Str near 1.
#pragma once

#include "engine/surface/surface.hpp"

namespace asperity {

struct TextureDirection {
  double wave = 0;   // rad from x towards y, 0 … π
  double lay = 0;    // rad, 0 … π: wave ± π/2
  double share = 0;  // power in the bin of `wave`; 1/360 if isotropic
};

// One transform, two grid copies. Throws Error{bad_value} for equal heights, under six longer cells along a
// side, or no wave in the band.
TextureDirection texture_direction(const Surface& surface);

}  // namespace asperity
