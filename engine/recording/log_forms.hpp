// SPDX-License-Identifier: GPL-3.0-or-later
// What the tables of a press (log_table.hpp) know of titles and cells beyond what any table does: what others
// call its columns, and units that stand behind a stroke or an underscore.
#pragma once

#include <string>
#include <string_view>

#include "engine/core/files/text_table.hpp"
#include "engine/core/quantity.hpp"

namespace asperity {

// A date or a time of day: "2026-11-23T10:00:00", "23.11.2026 10:00", "11/23/2026 10:00 AM", "10:00:03.2".
bool is_time_stamp(std::string_view cell);

// A day of this century counted from 1900, as spreadsheets keep dates: 36526 to 73415.
bool is_day_of_a_spreadsheet(const TextCell& cell);

// A title taken apart, however its unit stands in it: "Kraft / kN", "time_s", "Force (N)", "load kN".
struct LogTitle {
  std::string name;  // lower case, the first word
  std::string unit;  // "" where there is none
};
LogTitle log_title(std::string_view title);

// Whether a word may mean the column: its own name, or what others call it ("kraft" for load, "angle" for
// rotation).
bool means(std::string_view word, std::string_view column);
// Whether it can mean nothing else: an angle may be that of the stage or a turn by so much.
bool surely_means(std::string_view word, std::string_view column);

}  // namespace asperity
