// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/stamp_column.hpp"

#include <cmath>

#include "engine/core/files/text_table.hpp"

namespace asperity {

bool StampColumn::learn(std::string_view cell) {
  const TimeStamp stamp = read_time_stamp(cell, order_, clock_);
  if (stamp.kind == TimeStamp::Kind::none) return false;
  if (order_ == DateOrder::unsaid && stamp.may_be_day_first != stamp.may_be_month_first)
    order_ = stamp.may_be_day_first ? DateOrder::day_first : DateOrder::month_first;
  if (stamp.kind == TimeStamp::Kind::unsaid_order && unsaid_order_.empty()) unsaid_order_ = shown(cell);
  if (stamp.kind == TimeStamp::Kind::unsaid_clock && unsaid_clock_.empty()) unsaid_clock_ = shown(cell);
  return order_ != DateOrder::unsaid || (unsaid_order_.empty() && stamp.dated);
}

std::optional<std::string> StampColumn::doubt() const {
  if (!unsaid_order_.empty() && order_ == DateOrder::unsaid)
    return "holds dates such as " + unsaid_order_ +
           ", in which day and month may be either; dates=\"day first\" or dates=\"month first\" says which";
  if (!unsaid_clock_.empty() && clock_ == ClockForm::unsaid)
    return "holds times such as " + unsaid_clock_ +
           ", which may be hours and minutes or minutes and seconds; clock=\"h:min\" or clock=\"min:s\" says "
           "which";
  return {};
}

StampColumn::Reading StampColumn::read(std::string_view cell) {
  const TimeStamp stamp = read_time_stamp(cell, order_, clock_);
  switch (stamp.kind) {
    case TimeStamp::Kind::none:
      return {{}, shown(cell) + " is no date and no time of day, as the cells above are"};
    case TimeStamp::Kind::unsaid_order:
    case TimeStamp::Kind::unsaid_clock:
      return {{}, shown(cell) + " can be read in two ways; dates=, or clock=, says which is meant"};
    case TimeStamp::Kind::not_in_calendar:
      return {{},
              shown(cell) + " is in no calendar" +
                  (order_ == DateOrder::month_first ? " with the month first"
                   : order_ == DateOrder::day_first ? " with the day first"
                                                    : "")};
    case TimeStamp::Kind::known:
      break;
  }
  if (!first_) first_ = stamp;
  if (stamp.dated != first_->dated)
    return {{},
            shown(cell) + (stamp.dated ? " has a date, which the first one lacks"
                                       : " has no date, which the first one has")};
  if (stamp.zoned != first_->zoned)
    return {{},
            shown(cell) + (stamp.zoned ? " has a time zone, which the first one lacks"
                                       : " has no time zone, which the first one has")};
  Reading reading;
  reading.seconds = since_1970_ ? static_cast<double>(stamp.seconds) + stamp.fraction
                                : static_cast<double>(stamp.seconds - first_->seconds) +
                                      (stamp.fraction - first_->fraction);
  step(reading);
  return reading;
}

void StampColumn::step(Reading& reading) {
  constexpr double hour = 3600, day = 24 * hour;
  double now = *reading.seconds + added_;
  const double change = last_ ? now - *last_ : 0;
  const bool local = last_ && first_->dated && !first_->zoned && change >= -hour;
  // An hourly log repeats a time when clocks go back; others may repeat any time.
  const bool as_before = std::abs(change + hour - gap_) <= 0.25 * gap_;
  const bool hour_back = local && (change <= -hour / 2 || (change <= 0 && as_before && !repeats_));
  repeats_ = repeats_ || (last_ && change == 0);
  const bool day_over = last_ && !first_->dated && change < -day / 2;
  if (day_over && steps_back_ == StepsBack::midnight) {
    added_ += day;
  } else if (hour_back && steps_back_ == StepsBack::winter_time) {
    added_ += hour;
  } else if (day_over && !warned_) {
    warned_ = true;
    reading.warning =
        " is more than half a day before the time above; if midnight came between, steps_back=\"midnight\" "
        "adds the day";
  } else if ((hour_back || (local && change < 0)) && !warned_) {
    warned_ = true;
    reading.warning = std::string(change < 0 ? " is before the time above" : " is the time above once more") +
                      "; if summer time ended between them, steps_back=\"winter time\" adds the hour";
  }
  now = *reading.seconds + added_;
  if (last_ && now > *last_) gap_ = now - *last_;
  last_ = reading.seconds = now;
}

}  // namespace asperity
