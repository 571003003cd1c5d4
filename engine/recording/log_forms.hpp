// SPDX-License-Identifier: GPL-3.0-or-later
// Forms of titles and cells that loggers and spreadsheets write and that a table of a press (log_table.hpp)
// does not read: known so that its errors can say what was met and what to write instead.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/core/files/text_table.hpp"
#include "engine/core/quantity.hpp"

namespace asperity {

// A date or a time of day: "2026-11-23T10:00:00", "23.11.2026 10:00", "11/23/2026 10:00 AM", "10:00:03.2".
bool is_time_stamp(std::string_view cell);

// A day of this century counted from 1900, as spreadsheets keep dates: 36526 to 73415.
bool is_day_of_a_spreadsheet(const TextCell& cell);

// A unit alone, in brackets or not: "[s]", "kN". Nothing for any other text, and for an empty one.
std::optional<Quantity> unit_in_cell(std::string_view cell);
// The same without its brackets.
std::string bare_unit(std::string_view cell);

// A number with a unit after it: "10 MPa".
bool has_unit(std::string_view cell);

// A title taken apart, however its unit stands in it: "Kraft / kN", "time_s", "Force (N)", "load kN".
struct LogTitle {
  std::string name;  // lower case, the first word
  std::string unit;  // "" where there is none
};
LogTitle log_title(std::string_view title);

// Whether a word means the column: its own name, or what others call it ("kraft" for load, "angle" for
// rotation).
bool means(std::string_view word, std::string_view column);

}  // namespace asperity
