// SPDX-License-Identifier: GPL-3.0-or-later
// Chart of a study: error against run time, logarithmic, one line per way. Bars span fastest and slowest run;
// rings mark the Pareto front, crosses failed settings, triangles omitted settings at their expected time. A
// diamond marks an answer identical to the truth.
#pragma once

#include "engine/plot/chart.hpp"
#include "engine/study/study_result.hpp"

namespace asperity {

// Throws Error{bad_value} if no setting has an error.
LineChart study_chart(const StudyResult& result, const std::string& title);

}  // namespace asperity
