// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings of a press: load and perhaps the angle of the turned body, sampled all the time, as a logger
// writes them. What was done is for event_detection.hpp to find.
//
//   time [s], load [kN], angle [deg]
//   0.00,     0.012,     0.1
//   0.11,     0.009,     0.1
//
// Columns: time; load or pressure; angle (or rotation), which is a reading of the stage and not, as in a
// log of events, a turn by so much. Titles, units and separators are those of log_table.hpp.
#pragma once

#include <cstdint>
#include <string>

#include "engine/contact/press_request.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"
#include "engine/statistics/table_form.hpp"

namespace asperity {

class SourceFile;

struct PressRecording {
  std::string name;            // of the file, without its folders
  PressBy by = PressBy::load;  // or pressure
  Array<double> time;          // s, strictly increasing
  Array<double> load;          // N or Pa, NaN where the cell is missing; below zero too
  Array<double> angle;         // rad, NaN where missing; empty without such a column
  Array<std::uint32_t> line;   // of the file, from 1
};

// Rows with the same time, as a logger writes them that is faster than its clock tells.
enum class EqualTimes {
  refuse,
  spread,  // evenly until the next time; the last of them at the mean spacing of those before
};

// Throws Error{bad_file} with every problem of the file by line and column: what log_table.hpp refuses, no
// time, neither or both of load and pressure, a row without a time or with one that does not lie after the
// one before, a cell that is neither number nor missing, no row. Warns of columns that are left out.
PressRecording read_press_recording(const SourceFile& file, Monitor& monitor = Monitor::silent(),
                                    const TableForm& form = {}, EqualTimes equal_times = EqualTimes::refuse);

// Whether a table looks like a recording rather than a log of events: a hundred rows or more with times, no
// column for a dwell, a place or a seed, and no turn in any row. A file that cannot be read does not.
bool looks_like_recording(const SourceFile& file, const TableForm& form = {});

}  // namespace asperity
