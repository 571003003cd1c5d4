// SPDX-License-Identifier: GPL-3.0-or-later
// Holes in a recording: empty load cells and absent rows. O(rows).
//
// Rows are absent in a step of at least 2.5 usual steps: the longest of the median step, the step that one in
// twenty exceeds, and the median of the three steps before or after. Logging in bursts, at random, or rarely
// loses no rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/recording/press_recording.hpp"

namespace asperity {

struct RecordedHole {
  std::size_t sample;      // before the hole
  std::size_t cells = 0;   // rows without a load
  std::size_t absent = 0;  // estimated
  std::size_t missing() const { return cells + absent; }
};

struct RecordedHoles {
  std::vector<RecordedHole> holes;        // in order
  double median_step = 0, long_step = 0;  // s; one step in twenty exceeds long_step
};

// `row`: rows with a load, in order; at least three.
RecordedHoles recorded_holes(const PressRecording& recording, std::span<const std::uint32_t> row);

}  // namespace asperity
