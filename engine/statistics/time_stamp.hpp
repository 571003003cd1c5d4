// SPDX-License-Identifier: GPL-3.0-or-later
// Dates and times of day as loggers write them: ISO 8601 ("2026-11-23T10:00:03.2+01:00"), the local forms
// with points ("23.11.2026 10:00"), strokes or dashes ("11/23/2026 10:00 AM"), names of months
// ("23-Nov-2026"), and times of day or since a start alone ("10:00:03,2"). Dates with points have the day
// first; with strokes or dashes it may be either, and who reads them has to say, or to find a date that
// tells. The calendar is the Gregorian one, without leap seconds; a time without a zone is taken as it
// stands.
#pragma once

#include <cstdint>
#include <string_view>

namespace asperity {

enum class DateOrder { unsaid, day_first, month_first };
enum class ClockForm { unsaid, hours_minutes, minutes_seconds };  // of "10:30" alone

struct TimeStamp {
  enum class Kind {
    none,             // no date and no time
    known,            // read
    unsaid_order,     // "03/04/2026": the order of day and month is not known
    unsaid_clock,     // "10:30": hours and minutes, or minutes and seconds
    not_in_calendar,  // "2026-02-30", "25:00:00" behind a date
  };
  Kind kind = Kind::none;
  bool dated = false, zoned = false;
  // Of a date with strokes or dashes: which orders its own numbers allow.
  bool may_be_day_first = true, may_be_month_first = true;
  std::int64_t seconds = 0;  // since 1970-01-01 00:00 (of UTC where zoned), or since midnight
  double fraction = 0;       // of a second, 0 <= fraction < 1
};

TimeStamp read_time_stamp(std::string_view text, DateOrder order = DateOrder::unsaid,
                          ClockForm clock = ClockForm::unsaid);

// Days from 1970-01-01 to a date.
std::int64_t days_to_date(std::int64_t year, int month, int day);

}  // namespace asperity
