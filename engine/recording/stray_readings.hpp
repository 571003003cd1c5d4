// SPDX-License-Identifier: GPL-3.0-or-later
// Stray readings of a recording: up to three in a row that leave the lines through their neighbours, on ramps
// and holds alike, while the readings after them go on as those before. A running median over nine readings
// names the suspects (Hampel's filter). A suspect is stray if it also lies outside what the lines before it,
// after it and across it allow; so corners, steps and overshoots are kept.
//
// Where the load elsewhere rises and falls within a sample or two, two or three high readings may be a short
// press. They are kept, and so is a short rest between two different loads. One reading alone never is a
// press, and readings of less load within a hold are no release.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "engine/core/memory.hpp"

namespace asperity {

// Standard deviation of a reading, from second differences; the greater of those above and below `middle`.
double noise_of_bends(std::span<const double> time, std::span<const double> load, double middle);

// Puts each stray reading on the line across it and returns the numbers of those samples in order. `time`
// increases strictly; `noise` is estimated if it is not given. O(n).
Array<std::uint32_t> mend_stray_readings(std::span<const double> time, std::span<double> load,
                                         std::optional<double> noise);

}  // namespace asperity
