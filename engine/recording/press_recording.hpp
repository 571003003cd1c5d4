// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings of a press by a logger.
//
// time [s], load [kN], angle [deg]
// 0.00,     0.012,     0.1
// 0.11,     0.009,     0.1
//
// Columns: time; load or pressure; angle (or rotation), a reading of the stage and not a turn. Titles, units
// and separators as in log_table.hpp.
#pragma once

#include <cstdint>
#include <string>

#include "engine/contact/scene/press_request.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"
#include "engine/statistics/table_form.hpp"

namespace asperity {

class SourceFile;

struct PressRecording {
  std::string name;            // without folders
  PressBy by = PressBy::load;  // or pressure
  Array<double> time;          // s, strictly increasing
  Array<double> load;          // N or Pa, NaN where missing; may be negative
  Array<double> angle;         // rad, NaN where missing; empty without column
  Array<std::uint32_t> line;   // from 1
};

// From a logger faster than its clock.
enum class EqualTimes {
  refuse,
  spread,  // evenly until the next time; the last group at the mean spacing
};

// Throws Error{bad_file} with every problem by line and column: as log_table.hpp, no time, neither or both of
// load and pressure, a row without increasing time, an unreadable cell, no row. Warns of ignored columns.
PressRecording read_press_recording(const SourceFile& file, Monitor& monitor = Monitor::silent(),
                                    const TableForm& form = {}, EqualTimes equal_times = EqualTimes::refuse);

// A hundred rows or more with times, and no dwell, place, seed or turn. False for an unreadable file.
bool looks_like_recording(const SourceFile& file, const TableForm& form = {});

}  // namespace asperity
