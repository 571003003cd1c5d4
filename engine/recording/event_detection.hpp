// SPDX-License-Identifier: GPL-3.0-or-later
// Finds what was done to a specimen in a recording of its press (press_recording.hpp): rests without load,
// rises, holds, peaks, releases, and turns of the body while it lay without load.
//
// The noise is read off second differences: the median of their magnitude, over 0.6745, which neither ramps
// nor a few jumps move; the greater of that above and below half of the highest load. Where neighbouring
// readings are alike, as after a filter, the scatter and the number of independent readings follow from how
// alike (noise_correlation.hpp). The recording is cut into straight pieces (straight_pieces.hpp). Pieces that
// stay level, and neighbours of one level, are rests where they lie within `zero_drift` of the last rest,
// which the sensor's zero follows, and holds elsewhere. A hold begins and ends where the straight pieces
// beside it meet its level. What rises above the holds at both its sides is a peak: flattening goes by the
// highest load reached, so it becomes a press of its own, with the time above its half height for dwell;
// creep goes by the dwell of the hold after it.
//
// It takes ramps for straight near the holds. Loads closer than `same_load` without a
// rest between are one hold; a hold under `zero_drift` of the highest load is a rest. Whatever it cannot tell
// it says, with numbers, as a warning or an error.
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"
#include "engine/recording/press_recording.hpp"
#include "engine/specimen/protocol.hpp"

namespace asperity {

struct DetectionOptions {
  enum class Overshoot { press, ignore };
  std::optional<double> noise{};          // N or Pa, standard deviation of a sample
  std::optional<double> zero{};           // N or Pa, what the sensor reads without load, all along
  double zero_drift = 0.01;               // share of the highest load
  double same_load = 0.02;                // share of the load
  std::optional<double> shortest_hold{};  // s; else four usual steps of time
  std::optional<double> evidence{};       // squares of the noise that a cut must save; else 10 + 4 ln samples
  Overshoot overshoot = Overshoot::press;
  double least_overshoot = 0.01;                     // share of the load beside it; and six times the noise
  double least_turn = 0.5 * std::numbers::pi / 180;  // rad
  std::optional<double> turn_step{};                 // rad; turns are whole multiples of it
};

// A stretch of the recording and what it is.
struct RecordedSpan {
  enum class Kind { rest, rise, hold, peak, fall, release, turn };
  Kind kind = Kind::rest;
  double begin = 0, end = 0;  // s
  double load = 0;            // N or Pa above the zero: of a hold or peak, or reached by a rise or fall
  double load_error = 0;      // standard errors, from the noise
  double dwell_error = 0;     // s, of end - begin
  double angle = 0;           // rad, of a turn
  std::size_t first_line = 0, last_line = 0;
};
std::string_view name(RecordedSpan::Kind kind);

// What was found, and by which thresholds.
struct Detection {
  std::string name;  // of the file
  PressBy by = PressBy::load;
  std::size_t samples = 0, missing = 0;                    // missing: rows without a load
  std::size_t absent = 0;                                  // rows that gaps in time leave out, about
  double interval = 0;                                     // s, the median
  double noise = 0;                                        // N or Pa
  double highest = 0;                                      // load above zero
  double zero_low = 0, zero_high = 0;                      // readings without load
  bool rested = false;                                     // there were any
  double zero_drift = 0, shortest_hold = 0, evidence = 0;  // in N or Pa, s, squares of the noise
  double least_load = 0;  // a shortest hold of less than this beside zero may go unseen
  double least_step = 0;  // nor a change by less between two holds, one of them as short
  std::vector<RecordedSpan> spans;
  // The recording, thinned to what a chart shows: load above zero.
  Array<double> time, load;

  std::string text() const;
};

// The protocol of the recording, with recording() to show what was found. Events carry times and lines.
// Throws Error{bad_file} naming lines: no load above the noise, fewer than ten samples, loads or whole rows
// missing where more than a hold or a rest goes on, a turn under load or one that is no multiple of
// `turn_step`.
Protocol detect_events(const PressRecording& recording, const DetectionOptions& options = {},
                       Monitor& monitor = Monitor::silent());

}  // namespace asperity
