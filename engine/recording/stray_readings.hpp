// SPDX-License-Identifier: GPL-3.0-or-later
// Stray readings: up to three in a row off the lines through their neighbours. A running median over nine
// readings finds suspects (Hampel's filter); a suspect is stray if it is also off the lines before, after and
// across it, so corners, steps and overshoots stay. Two or three readings may also be a press, or a rest
// between different loads, if the load changes as fast elsewhere. A single reading is never a press, and
// lower readings in a hold are no release.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "engine/core/memory.hpp"

namespace asperity {

// Standard deviation from second differences; the greater value of above and below `middle`.
double noise_of_bends(std::span<const double> time, std::span<const double> load, double middle);

// Moves stray readings to the line across them; returns their numbers in order. `time` increases strictly.
// O(n).
Array<std::uint32_t> mend_stray_readings(std::span<const double> time, std::span<double> load,
                                         std::optional<double> noise);

}  // namespace asperity
