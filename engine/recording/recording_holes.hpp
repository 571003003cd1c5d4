// SPDX-License-Identifier: GPL-3.0-or-later
// The inner working of event_detection.hpp: where a recording holds no load, because cells are empty or
// because rows are absent. O(rows).
//
// Rows are absent where time goes on by two and a half usual steps or more. Usual is the longest of what half
// of all steps stay within, what all but one in twenty do, and what two of the three before it or after it
// do: a logger that writes in bursts, at random, or seldom while nothing happens loses no rows by that.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/recording/press_recording.hpp"

namespace asperity {

// Between a sample of the load and the next.
struct RecordedHole {
  std::size_t sample;      // the one before it
  std::size_t cells = 0;   // rows without a load
  std::size_t absent = 0;  // rows, as many as usual steps would have made
  std::size_t missing() const { return cells + absent; }
};

struct RecordedHoles {
  std::vector<RecordedHole> holes;        // in order
  double median_step = 0, long_step = 0;  // s, between rows; one in twenty is longer than the latter
};

// `row` holds the rows that have a load, in order; three or more.
RecordedHoles recorded_holes(const PressRecording& recording, std::span<const std::uint32_t> row);

}  // namespace asperity
