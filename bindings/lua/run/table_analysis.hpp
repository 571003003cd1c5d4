// SPDX-License-Identifier: GPL-3.0-or-later
// What tables and notebooks say of their columns: means with intervals, fits, histograms and charts. Each
// method takes its table by table_of_self (table_values.hpp).
#pragma once

#include <vector>

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "engine/run/notebook_chart.hpp"

namespace asperity::lua {

// Methods of tables and of notebooks, and the types of the records that they give.
std::vector<Function> table_analysis_methods();
std::vector<const RecordInfo*> table_analysis_results();

Function mean_method();
Function histogram_method();
Function fit_method();
Function chart_method();
const RecordInfo& histogram_type();
std::vector<const RecordInfo*> fit_types();

// A fit as a record of t:fit holds it; nothing for any other value.
std::optional<FittedCurve> fitted_curve_of(const Argument& value);

}  // namespace asperity::lua
