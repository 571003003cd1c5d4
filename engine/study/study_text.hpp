// SPDX-License-Identifier: GPL-3.0-or-later
// Output of a work-precision study: the table of `print` with the cheapest settings for 10 %, 1 % and 0.1 %,
// and a CSV table.
#pragma once

#include <string>
#include <vector>

#include "engine/core/files/json.hpp"
#include "engine/statistics/table.hpp"
#include "engine/study/study_result.hpp"

namespace asperity {

// Lines of equally many cells as aligned columns; every line begins with a line end.
using TextLine = std::vector<std::string>;
std::string aligned(const std::vector<TextLine>& lines);

// "1.2 %", "1234 %".
std::string share_text(double share);
// "1.2 %" (relative) or "1.2e-07".
std::string error_text(double error, bool relative);
// "12.3 ms", "4.2 s", "3 min 20 s", "2 h 5 min".
std::string seconds_text(double seconds);

// No final line end.
std::string study_text(const StudyResult& result);

// Columns: way, knobs, value, error and so on, seconds in s.
Table study_table(const StudyResult& result);

Json to_json(const Knobs& knobs);
Json to_json(const StudyRequest& request);
// The result without times.
Json answers_json(const StudyResult& result);

}  // namespace asperity
