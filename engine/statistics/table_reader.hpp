// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of measured numbers as loggers and spreadsheets write them: text under a line of heads, with or
// without units. The numbers of a column with a unit come in SI, each rounded once; those of one without stay
// as they are, whole ones whole. Dates and times of day become seconds. A column whose cells are no numbers
// holds texts. What can be read in more than one way is asked for by the name of the choice (table_form.hpp).
#pragma once

#include "engine/core/files/source_file.hpp"
#include "engine/core/monitor.hpp"
#include "engine/statistics/table.hpp"
#include "engine/statistics/table_form.hpp"

namespace asperity {

// The table, named after its file. A cell that is empty, nan, NA, null or dashes is empty among numbers.
// Throws Error{bad_file} for bytes that are no text, and with every problem by line and column: a unit that
// is not known, two columns of one name, a row of another length, a cell unlike the others of its column, a
// number or a date that can be read in two ways. Warns of lines below the table and of columns that are left
// out. Holds the text of all cells meanwhile.
Table read_measured_table(const SourceFile& file, const TableForm& form = {},
                          Monitor& monitor = Monitor::silent());

}  // namespace asperity
