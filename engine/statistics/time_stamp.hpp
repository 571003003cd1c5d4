// SPDX-License-Identifier: GPL-3.0-or-later
// Dates and times of loggers: ISO 8601, "23.11.2026 10:00", "11/23/2026 10:00 AM", "23-Nov-2026",
// "10:00:03,2". With points, the day is first; slashes and dashes are ambiguous. Gregorian, without leap
// seconds; times without a zone are not converted.
#pragma once

#include <cstdint>
#include <string_view>

namespace asperity {

enum class DateOrder { unsaid, day_first, month_first };
enum class ClockForm { unsaid, hours_minutes, minutes_seconds };  // of "10:30"

struct TimeStamp {
  enum class Kind {
    none,
    known,
    unsaid_order,     // "03/04/2026": day or month first?
    unsaid_clock,     // "10:30": h:min or min:s?
    not_in_calendar,  // "2026-02-30", "25:00:00" after a date
  };
  Kind kind = Kind::none;
  bool dated = false, zoned = false;
  // Possible for these numbers.
  bool may_be_day_first = true, may_be_month_first = true;
  std::int64_t seconds = 0;  // since 1970-01-01 00:00 (UTC if zoned), or midnight
  double fraction = 0;       // of a second, in [0, 1)
};

TimeStamp read_time_stamp(std::string_view text, DateOrder order = DateOrder::unsaid,
                          ClockForm clock = ClockForm::unsaid);
inline bool is_time_stamp(std::string_view text) {
  return read_time_stamp(text).kind != TimeStamp::Kind::none;
}

}  // namespace asperity
