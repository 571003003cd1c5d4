// SPDX-License-Identifier: GPL-3.0-or-later
// A study of work and precision as people and machines read it: the table that `print` shows, with the
// cheapest setting for 10 %, 1 % and 0.1 %; the rows as a table of columns for a CSV file; and the
// short texts of an error and of a time.
#pragma once

#include <string>
#include <vector>

#include "engine/core/files/json.hpp"
#include "engine/statistics/table.hpp"
#include "engine/study/study_result.hpp"

namespace asperity {

// The cells of a line, as many in each; and lines one below the other, each after a line end.
using TextLine = std::vector<std::string>;
std::string aligned(const std::vector<TextLine>& lines);

// "1.2 %", "1234 %".
std::string share_text(double share);
// "1.2 %" where errors are relative, "1.2e-07" where they are not.
std::string error_text(double error, bool relative);
// "12.3 ms", "4.2 s", "3 min 20 s", "2 h 5 min".
std::string seconds_text(double seconds);

// Several lines without a line end after the last.
std::string study_text(const StudyResult& result);

// Columns: way, the knobs, value, error and so on, seconds in s. One row a setting.
Table study_table(const StudyResult& result);

// The knobs of a setting as JSON.
Json to_json(const Knobs& knobs);
// What was asked: the ways with their settings, the truth, repeats and budget.
Json to_json(const StudyRequest& request);
// What came out, without anything that a clock said.
Json answers_json(const StudyResult& result);

}  // namespace asperity
