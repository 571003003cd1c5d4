// SPDX-License-Identifier: GPL-3.0-or-later
// Press logs: what was done to a specimen, a row an event, as people keep it in a spreadsheet.
//
//   time [s], pressure [MPa], rotation [deg], dwell [min]
//   0,        152.78,         0,              10
//   900,      152.78,         90,             10
//
// A row turns the upper body by `rotation` from where it lies, then presses to `pressure`, or to `load` on
// the whole tile, for `dwell`; a zero takes the load off, and so does an empty cell, with a warning. A column
// `place` (or `seed`) lifts the body and puts it down afresh before the turn. A body under load is released
// before it is placed or turned. The time is kept and nothing waits for it; a dwell that goes on past the
// time of the next row is warned of.
//
// Every row is an event: a recording sampled all the time is for press_recording.hpp, and this reader warns
// of a table that looks like one. Titles that begin with "result " are what was measured, and are left out.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/monitor.hpp"
#include "engine/specimen/protocol.hpp"
#include "engine/statistics/table_form.hpp"

namespace asperity {

class SourceFile;

// Titles, units and separators are those of log_table.hpp. Columns of another name are left out with a
// warning. Throws Error{bad_file} with every problem of the file, each by line and column:
// a column without its unit or given twice, both pressure and load or neither, a row of another length, a
// cell that is no number, a negative pressure, load or dwell, a time that is missing or runs backwards.
Protocol read_press_log(const std::string& path, Monitor& monitor = Monitor::silent());
Protocol read_press_log(const SourceFile& file, Monitor& monitor = Monitor::silent(),
                        const TableForm& form = {});

// The log that reads back as this protocol, to the last bit of every number: in MPa, N, deg and min if
// they can say them, else in SI units. Times are kept if every event has one. A release that was not
// written where a body under load is placed or turned is there when it is read. Throws
// Error{bad_value} naming the first event that a log has no way to say: a shift, a press to anything but a
// pressure or load above zero, both of these in one protocol. Columns of results, with a value or none for
// every event of the protocol, are titled "result " and so left out by the reader; presses alone show theirs.
struct ResultColumn {
  std::string title;  // "approach [m]"
  std::vector<std::optional<double>> values;
};
std::string press_log_text(const Protocol& protocol, std::span<const ResultColumn> results = {});

}  // namespace asperity
