// SPDX-License-Identifier: GPL-3.0-or-later
// A ramp between two known levels that its noise hides: where it begins and ends, by least squares of level,
// ramp and level over a grid of centres and lengths, refined around the best. Some ten thousand additions.
#pragma once

#include <cstddef>
#include <span>

namespace asperity {

struct RampInNoise {
  double begin = 0, end = 0;  // s
  double misfit = 0;          // squares, summed over the samples given
};

// Of the samples given, in time; three or more.
RampInNoise fit_hidden_ramp(std::span<const double> time, std::span<const double> value, double from,
                            double to);

// Least squared misfit of the two levels that pass into each other at once, where that fits best.
double step_misfit(std::span<const double> value, double from, double to);

}  // namespace asperity
