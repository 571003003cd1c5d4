// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the events in a recording of a press: rests, rises, holds, peaks, releases, turns.
//
// The noise is the median magnitude of second differences over 0.6745, the greater value of above and below
// half of the highest load. Level pieces (recording_marks.hpp), merged with equal neighbours, are rests
// within `zero_drift` of the last rest, which follows the sensor's zero. Other levels are holds, which end
// where adjacent pieces meet the level. A rise above the holds on both sides is a peak, hence a press,
// because flattening depends on the highest load; its dwell is the time above half height.
//
// Ramps are assumed straight near holds. Adjacent loads within `same_load` are one hold; a hold below
// `zero_drift` of the highest load is a rest.
#pragma once

#include <string>
#include <vector>

#include "engine/recording/recording_marks.hpp"
#include "engine/specimen/protocol.hpp"

namespace asperity {

struct RecordedSpan {
  enum class Kind { rest, rise, hold, peak, fall, release, turn };
  Kind kind = Kind::rest;
  double begin = 0, end = 0;  // s
  double load = 0;            // N or Pa above zero, of or after the span
  double load_error = 0;      // standard error, from the noise
  double dwell_error = 0;     // s, of end - begin
  double angle = 0;           // rad, of a turn
  std::size_t first_line = 0, last_line = 0;
};
std::string_view name(RecordedSpan::Kind kind);

struct Detection {
  std::string name;
  PressBy by = PressBy::load;
  std::size_t samples = 0, missing = 0;                    // missing: without a load
  std::size_t absent = 0;                                  // estimated, in gaps of time
  double interval = 0;                                     // s, the median
  double noise = 0;                                        // N or Pa
  double highest = 0;                                      // load above zero
  double zero_low = 0, zero_high = 0;                      // readings without load
  bool rested = false;                                     // whether there were any
  double zero_drift = 0, shortest_hold = 0, evidence = 0;  // in N or Pa, s, squares of the noise
  double least_load = 0;                                   // shorter holds below may be missed
  double least_step = 0;                                   // smaller steps may be missed
  std::vector<RecordedSpan> spans;
  // Thinned for a chart: load above zero.
  Array<double> time, load;

  std::string text() const;
};

// Throws Error{bad_file}: no load above the noise, fewer than ten samples, loads or rows missing outside a
// hold or rest, a turn under load or not a multiple of `turn_step`.
Protocol detect_events(const PressRecording& recording, const DetectionOptions& options = {},
                       Monitor& monitor = Monitor::silent());

}  // namespace asperity
