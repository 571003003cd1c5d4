// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/cell_column.hpp"

#include <cmath>

#include "engine/statistics/table_head.hpp"

namespace asperity {

bool StampColumn::learn(std::string_view cell) {
  const TimeStamp stamp = read_time_stamp(cell, form_.dates, form_.clock);
  if (stamp.kind == TimeStamp::Kind::none) return false;
  if (form_.dates == DateOrder::unsaid && stamp.may_be_day_first != stamp.may_be_month_first)
    form_.dates = stamp.may_be_day_first ? DateOrder::day_first : DateOrder::month_first;
  if (stamp.kind == TimeStamp::Kind::unsaid_order && unsaid_order_.empty()) unsaid_order_ = shown(cell);
  if (stamp.kind == TimeStamp::Kind::unsaid_clock && unsaid_clock_.empty()) unsaid_clock_ = shown(cell);
  return form_.dates != DateOrder::unsaid || (unsaid_order_.empty() && stamp.dated);
}

std::optional<std::string> StampColumn::doubt() const {
  if (!unsaid_order_.empty() && form_.dates == DateOrder::unsaid)
    return "holds dates such as " + unsaid_order_ +
           " with an ambiguous day and month; give dates=\"day first\" or dates=\"month first\"";
  if (!unsaid_clock_.empty() && form_.clock == ClockForm::unsaid)
    return "holds times such as " + unsaid_clock_ +
           ", hours and minutes or minutes and seconds; give clock=\"h:min\" or clock=\"min:s\"";
  return {};
}

CellReading StampColumn::read(std::string_view cell) {
  const TimeStamp stamp = read_time_stamp(cell, form_.dates, form_.clock);
  const auto refused = [&](const std::string& why) {
    return CellReading{CellKind::unreadable, 0, shown(cell) + why};
  };
  using Kind = TimeStamp::Kind;
  if (stamp.kind == Kind::none) return refused(" is no date and no time of day, as the cells above are");
  if (stamp.kind == Kind::not_in_calendar)
    return refused(std::string(" is in no calendar") +
                   (form_.dates == DateOrder::month_first ? " with the month first"
                    : form_.dates == DateOrder::day_first ? " with the day first"
                                                          : ""));
  if (stamp.kind != Kind::known) return refused(" can be read in two ways; give dates= or clock=");
  if (!first_) first_ = stamp;
  if (stamp.dated != first_->dated)
    return refused(stamp.dated ? " has a date, which the first one lacks"
                               : " has no date, which the first one has");
  if (stamp.zoned != first_->zoned)
    return refused(stamp.zoned ? " has a time zone, which the first one lacks"
                               : " has no time zone, which the first one has");
  CellReading reading{CellKind::number};
  reading.value = form_.stamps_since_1970 ? static_cast<double>(stamp.seconds) + stamp.fraction
                                          : static_cast<double>(stamp.seconds - first_->seconds) +
                                                (stamp.fraction - first_->fraction);
  step(reading);
  return reading;
}

void StampColumn::step(CellReading& reading) {
  constexpr double hour = 3600, day = 24 * hour;
  double now = reading.value + added_;
  const double change = last_ ? now - *last_ : 0;
  const bool local = last_ && first_->dated && !first_->zoned && change >= -hour;
  // An hourly log repeats a time when clocks go back; others may do so any time.
  const bool as_before = std::abs(change + hour - gap_) <= 0.25 * gap_;
  const bool hour_back = local && (change <= -hour / 2 || (change <= 0 && as_before && !repeats_));
  repeats_ = repeats_ || (last_ && change == 0);
  const bool day_over = last_ && !first_->dated && change < -day / 2;
  if (day_over && form_.steps_back == StepsBack::midnight) {
    added_ += day;
  } else if (hour_back && form_.steps_back == StepsBack::winter_time) {
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
  now = reading.value + added_;
  if (last_ && now > *last_) gap_ = now - *last_;
  last_ = reading.value = now;
}

CellColumn::CellColumn(Kind kind, std::string unit, std::optional<Dimension> dimension, const TableForm& form)
    : kind_(kind),
      unit_(std::move(unit)),
      dimension_(dimension),
      since_1970_(form.stamps_since_1970),
      stamps_(form) {
  if (kind_ == Kind::days || kind_ == Kind::stamps) dimension_ = dimension::time;
  if (kind_ != Kind::numbers || unit_.empty()) return;
  const Quantity parsed = parse_unit(unit_);
  factor_ = parsed.value;
  dimension_ = parsed.dimension;
}

double CellColumn::day(double number) {
  constexpr double first_of_1970 = 25569, day = 86400;
  if (!first_day_) first_day_ = since_1970_ ? first_of_1970 : number;
  return (number - *first_day_) * day;
}

CellReading CellColumn::other_than_number(const std::string& text, CellKind kind) {
  const auto refused = [&](const std::string& why) {
    return CellReading{CellKind::unreadable, 0, shown(text) + why};
  };
  if (kind == CellKind::too_large) return refused(" is too large for a number");
  if (kind_ == Kind::days) return refused(" is no day of a spreadsheet, which counts from 1900");
  if (const auto own = quantity_in_cell(text)) {
    if (!dimension_) dimension_ = own->dimension;
    if (own->dimension == *dimension_) return {CellKind::number, own->value};
    return refused(" is " + describe(own->dimension) + " where " + describe(*dimension_) + " is wanted");
  }
  if (kind_ == Kind::numbers && is_time_stamp(text))
    return refused(" is a date or a time of day, and the column has the unit \"" + unit_ +
                   "\"; remove the unit from its head to read dates and times");
  return refused(" is no number");
}

CellReading CellColumn::read(const std::string& text, const NumberForm& form, bool exactly) {
  TextCell number = read_number(text, form);
  if (number.kind == CellKind::hole) return {number.kind, number.value};
  if (kind_ == Kind::stamps) return stamps_.read(text);
  const bool readable = number.kind == CellKind::number || number.kind == CellKind::infinite;
  if (!readable) return other_than_number(text, number.kind);
  if (kind_ == Kind::quantities)
    return {CellKind::unreadable, 0, shown(text) + " has no unit, as the cells above it have"};
  if (kind_ == Kind::days) return {number.kind, day(number.value)};
  if (factor_ == 1 || number.kind == CellKind::infinite) return {number.kind, number.value};
  if (!exactly) return {number.kind, number.value * factor_};
  try {
    return {CellKind::number, parse_quantity(*plain_number(text, form) + " " + unit_).value};
  } catch (const Error& error) {
    return {CellKind::unreadable, 0, error.what()};
  }
}

}  // namespace asperity
