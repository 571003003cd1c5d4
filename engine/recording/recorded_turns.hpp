// SPDX-License-Identifier: GPL-3.0-or-later
// The inner working of event_detection.hpp: turns of the body between the loads of a recording. O(rows).
#pragma once

#include <cstddef>
#include <vector>

#include "engine/recording/recording_marks.hpp"

namespace asperity {

struct RecordedTurn {
  double time;   // s
  double angle;  // rad
  std::size_t line;
};

// In the order of time; none where no angle was recorded. `highest` is the highest load, N or Pa. Throws what
// detect_events does for turns.
std::vector<RecordedTurn> recorded_turns(const PressRecording& recording, const DetectionOptions& options,
                                         const RecordingMarks& marks, double highest);

}  // namespace asperity
