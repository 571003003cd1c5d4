// SPDX-License-Identifier: GPL-3.0-or-later
// Press logs: the events of a specimen, one per row.
//
// time [s], pressure [MPa], rotation [deg], dwell [min]
// 0,        152.78,         0,              10
// 900,      152.78,         90,             10
//
// A row turns the upper body by `rotation`, then presses to `pressure`, or to `load` on the whole tile, for
// `dwell`. Zero, or an empty cell with a warning, removes the load. A column `place` (or `seed`) places the
// body anew before the turn. A loaded body is released first. Times are stored only. Ignores columns titled
// "result ".
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
class SpecimenPair;

// Titles, units and separators as in log_table.hpp. Warns of unknown columns, of a dwell beyond the next row,
// and of a table like a recording. Throws Error{bad_file} with every problem by line and column: a column
// without unit or given twice, both pressure and load or neither, a row of another length, no number, a
// negative pressure, load or dwell, a time missing or running backwards.
Protocol read_press_log(const SourceFile& file, Monitor& monitor = Monitor::silent(),
                        const TableForm& form = {});

// The text reads back as this protocol, to the last bit: in MPa, N, deg and min if exact, else in SI units.
// Omits times unless every event has one, and releases before placing or turning. Throws Error{bad_value} for
// the first event without a column: a shift, a press to anything but a pressure or load above zero, or both
// kinds. `results`: a value or none per event.
struct ResultColumn {
  std::string title;  // "approach [m]"
  std::vector<std::optional<double>> values;
};
std::string press_log_text(const Protocol& protocol, std::span<const ResultColumn> results = {});

// The history of a pair. Presses all by load, or all by pressure, stay as requested; otherwise they get their
// mean pressures. A press to zero is a release. Results: load or pressure, approach, area fraction, peak
// pressure, in SI. Throws Error{bad_state} without history, and as press_log_text does.
std::string bench_log_text(const SpecimenPair& pair);

}  // namespace asperity
