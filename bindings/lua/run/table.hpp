// SPDX-License-Identifier: GPL-3.0-or-later
// lab.table: tables of measured or computed numbers, read from files, made of rows or taken from notebooks.
// An immutable value whose methods return new ones. Methods that notebooks have too are in table_methods();
// they take their table by table_of_self (table_values.hpp).
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

// Methods of tables and of notebooks: those that choose and join rows.
std::vector<Function> table_methods();

// What tables and notebooks say of their columns: means with intervals, fits, histograms and charts
// (table_statistics.cpp, table_fit.cpp, table_chart.cpp), and the types of the records that they give.
std::vector<Function> table_analysis_methods();
std::vector<const RecordInfo*> table_analysis_results();

// The methods one by one.
Function mean_method();
Function histogram_method();
Function fit_method();
Function chart_method();
const RecordInfo& histogram_type();

// The curve of a fit; nothing for any other value.
std::optional<FittedCurve> fitted_curve_of(const Argument& value);

}  // namespace asperity::lua
