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

std::vector<Function> table_methods();

// Statistics of columns (table_statistics.cpp, table_fit.cpp, table_chart.cpp), and their record types.
std::vector<Function> table_analysis_methods();
std::vector<const RecordInfo*> table_analysis_results();

Function mean_method();
Function histogram_method();
Function fit_method();
Function chart_method();
const RecordInfo& histogram_type();

std::optional<FittedCurve> fitted_curve_of(const Argument& value);

}  // namespace asperity::lua
