// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "engine/run/ledger.hpp"
#include "engine/run/notebook.hpp"
#include "engine/run/notebook_chart.hpp"
#include "engine/statistics/table.hpp"

namespace asperity::lua {

// lab.table: immutable tables from files, rows or notebooks.
Class make_class(For<asperity::Table>);

Module table_module();

// The table, or the notebook's present rows.
std::shared_ptr<const asperity::Table> table_of_self(const Call& call);

// Also of notebooks; they read table_of_self().
std::vector<Function> table_methods();
// Types of their results.
std::vector<const RecordInfo*> table_results();

// table_rows.cpp: single rows and cells, expectations.
std::vector<Function> row_methods();
// In a dry run, notes the columns of a row that a notebook takes (notebook.cpp).
void note_columns(const Call& call);
// table_text.cpp: t:show and lab.say.
Function show_method();
Function say_function();
// table_statistics.cpp
Function mean_method();
Function histogram_method();
// Refuses a table in place of the column.
void look_at_histogram(const Call& call);
const RecordInfo& histogram_type();
// table_fit.cpp
Function fit_method();
// table_chart.cpp
Function chart_method();

// Nothing unless the value is a fit.
std::optional<FittedCurve> fitted_curve_of(const Argument& value);

// lab.notebook: rows with free columns, expectations and charts.
Class make_class(For<Notebook>);
Function notebook_function();
extern const Block<NotebookChart> notebook_chart_block;

// lab.knob: numbers that the user may change. lab.knob.set moves a knob interactively.
Module knob_module();
// No effect without knobs or in a case.
void note_knobs(const Session& session);

// lab.ledger: the costs of all calls, field reads and turns of iterators, entered by the calling frames.
Class make_class(For<LedgerReport>);
Function ledger_function();

}  // namespace asperity::lua
