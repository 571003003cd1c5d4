// SPDX-License-Identifier: GPL-3.0-or-later
// Reads measured tables. Numbers with a unit become SI, each rounded once; without a unit, whole numbers stay
// whole. Dates and times become seconds; columns without numbers are text.
#pragma once

#include "engine/core/files/source_file.hpp"
#include "engine/core/monitor.hpp"
#include "engine/statistics/table.hpp"
#include "engine/statistics/table_form.hpp"

namespace asperity {

// Named after its file. Among numbers, nan, NA, null and dashes are empty. Throws Error{bad_file} for bytes
// other than text, and lists problems by line and column: unknown units, repeated names, rows of other
// lengths, unlike cells, ambiguous numbers or dates (table_form.hpp). Warns of omitted columns and lines.
// Memory: the text of all cells.
Table read_measured_table(const SourceFile& file, const TableForm& form = {},
                          Monitor& monitor = Monitor::silent());

}  // namespace asperity
