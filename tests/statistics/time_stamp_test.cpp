// SPDX-License-Identifier: GPL-3.0-or-later
// Dates and times of day against the calendar.
#include "engine/statistics/time_stamp.hpp"

#include <gtest/gtest.h>

#include <string>

namespace asperity::time_stamp_test {
namespace {

using Kind = TimeStamp::Kind;

std::int64_t days_to(const std::string& date) { return read_time_stamp(date).seconds / 86400; }

TEST(TimeStamp, DaysAgreeWithTheCalendarOfFourCenturies) {
  EXPECT_EQ(days_to("1970-01-01"), 0);
  EXPECT_EQ(days_to("2000-03-01"), 11017);
  EXPECT_EQ(days_to("1899-12-30"), -25569);
  const auto leap = [](int year) { return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0); };
  std::int64_t day = days_to("1900-01-01");
  for (int year = 1900; year < 2300; ++year)
    for (int month = 1; month <= 12; ++month) {
      const std::string date = std::to_string(year) + "-" + std::to_string(month) + "-1";
      ASSERT_EQ(days_to(date), day) << date;
      const bool short_month = month == 4 || month == 6 || month == 9 || month == 11;
      day += month == 2 ? (leap(year) ? 29 : 28) : short_month ? 30 : 31;
    }
}

TEST(TimeStamp, WhatIsNone) {
  for (const char* text : {"",        "1",           "1.5",          "-3",          "1e5",
                           "12:3",    "12:",         ":30",          "a12:30:00",   "1.2.3.4",
                           "2026-11", "2026-11-23x", "2026-11-23 x", "2026-11-23T", "10:00:00 Q",
                           "1/2",     "23. 4",       "1-2-3",        "10:00:00:00", "2026-11-23 10:00:00.",
                           "5 kN",    "3 mar",       "10:00:00+01xy"})
    EXPECT_EQ(read_time_stamp(text).kind, Kind::none) << text;
  EXPECT_EQ(read_time_stamp(std::string(100000, '1') + ":00:00").kind, Kind::none);
}

TEST(TimeStamp, WhatIsInNoCalendar) {
  for (const char* text : {"2026-02-29", "2026-13-01", "2026-00-10", "31.04.2026", "32.01.2026",
                           "2026-11-23 25:00:00", "2026-11-23 10:60", "13:00:00 PM", "0:30 AM", "13/14/2026"})
    EXPECT_EQ(read_time_stamp(text).kind, Kind::not_in_calendar) << text;
  EXPECT_EQ(read_time_stamp("2024-02-29").kind, Kind::known);
  EXPECT_EQ(read_time_stamp("2026-11-23 24:00:00").seconds, read_time_stamp("2026-11-24").seconds);
}

TEST(TimeStamp, ClocksOfTwelveHours) {
  EXPECT_EQ(read_time_stamp("12:00:00 AM").seconds, 0);
  EXPECT_EQ(read_time_stamp("12:30 am").seconds, 1800);
  EXPECT_EQ(read_time_stamp("12:00:00 PM").seconds, 43200);
  EXPECT_EQ(read_time_stamp("1:05:07 p.m.").seconds, 47107);
}

TEST(TimeStamp, FractionsAndZones) {
  EXPECT_EQ(read_time_stamp("00:00:01.25").fraction, 0.25);
  EXPECT_EQ(read_time_stamp("00:00:01,5").fraction, 0.5);
  EXPECT_EQ(read_time_stamp("01:02.5").seconds, 62);  // minutes and seconds: only seconds have fractions
  const std::int64_t noon = read_time_stamp("2026-07-01T12:00:00Z").seconds;
  for (const char* text : {"2026-07-01T14:00:00+02:00", "2026-07-01T14:00+02", "2026-07-01 08:30:00-0330"}) {
    EXPECT_EQ(read_time_stamp(text).seconds, noon) << text;
    EXPECT_TRUE(read_time_stamp(text).zoned) << text;
  }
  EXPECT_FALSE(read_time_stamp("2026-07-01T12:00:00").zoned);
}

TEST(TimeStamp, OrdersThatTheNumbersAllow) {
  const TimeStamp either = read_time_stamp("03/04/2026"), day = read_time_stamp("13/04/2026");
  EXPECT_EQ(either.kind, Kind::unsaid_order);
  EXPECT_TRUE(either.may_be_day_first && either.may_be_month_first);
  EXPECT_TRUE(day.may_be_day_first && !day.may_be_month_first);
  EXPECT_EQ(read_time_stamp("03/04/2026", DateOrder::day_first).seconds, 86400 * days_to("2026-04-03"));
  EXPECT_EQ(read_time_stamp("03-04-26", DateOrder::month_first).seconds, 86400 * days_to("2026-03-04"));
  EXPECT_EQ(read_time_stamp("03.04.2026").seconds, 86400 * days_to("2026-04-03"));
}

}  // namespace
}  // namespace asperity::time_stamp_test
