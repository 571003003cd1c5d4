// SPDX-License-Identifier: GPL-3.0-or-later
// Stray readings of a recording: up to three in a row off the lines through their neighbours, on ramps and
// holds. A running median over nine readings finds suspects (Hampel's filter). A suspect is stray if it is
// also off the lines before, after and across it. So corners, steps and overshoots stay.
//
// If the load rises and falls within one or two samples elsewhere, two or three high readings may be a short
// press. Such readings stay, and so does a short rest between two different loads. A single reading is never
// a press, and lower readings within a hold are no release.
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
