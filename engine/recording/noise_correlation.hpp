// SPDX-License-Identifier: GPL-3.0-or-later
// The inner working of event_detection.hpp: how alike neighbouring readings of a recording scatter, as they
// do after a filter. Noise is taken for a first-order autoregression with the coefficient r, whose means over
// n readings are known as those of n (1 - r)/(1 + r) independent ones (Bartlett 1935). Second differences
// over L readings have the variance s² (1.5 - 2 r^L + 0.5 r^2L); the medians of their magnitudes at L = 1 and
// at a greater one give r and s. They are taken of what the lines of the pieces leave, so that ramps do not
// move them, nor a clock that jitters on a ramp.
#pragma once

#include <optional>
#include <span>

#include "engine/recording/straight_pieces.hpp"

namespace asperity {

struct NoiseCorrelation {
  double deviation = 0;    // of a reading
  double independent = 1;  // the share of independent readings among n
};

// Looked for within the pieces. Nothing for noise that is white as far as can be told (r below 0.4), or where
// too few readings lie within pieces. `time` and `value` are as long as the pieces tell. O(n).
std::optional<NoiseCorrelation> noise_correlation(std::span<const double> time, std::span<const double> value,
                                                  std::span<const StraightPiece> pieces);

}  // namespace asperity
