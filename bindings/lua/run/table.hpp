// SPDX-License-Identifier: GPL-3.0-or-later
// lab.table: tables from files, rows or notebooks. Tables are immutable; methods return new tables. Methods
// shared with notebooks are in table_methods() and read their table by table_of_self (table_values.hpp).
#pragma once

#include <optional>
#include <vector>

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "engine/run/notebook_chart.hpp"
#include "engine/statistics/table.hpp"

namespace asperity::lua {

template <>
const Class& class_of<asperity::Table>();

const Module& table_module();

// Methods of tables and notebooks that select and join rows.
std::vector<Function> table_methods();

// All statistics of columns, and their record types.
std::vector<Function> table_analysis_methods();
std::vector<const RecordInfo*> table_analysis_results();

// table_statistics.cpp
Function mean_method();
Function histogram_method();
// table_fit.cpp
Function fit_method();
// table_chart.cpp
Function chart_method();
const RecordInfo& histogram_type();

// Nothing unless the value is a fit.
std::optional<FittedCurve> fitted_curve_of(const Argument& value);

}  // namespace asperity::lua
