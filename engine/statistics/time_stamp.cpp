// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/time_stamp.hpp"

#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <utility>

#include "engine/core/files/text_table.hpp"

namespace asperity {

namespace {

struct DateParts {
  int year = 0, month = 0, day = 0;
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

class StampReader {
 public:
  explicit StampReader(std::string_view text) : rest_(text) {}

  bool at_end() const { return rest_.empty(); }
  std::string_view rest() const { return rest_; }
  char front() const { return rest_.empty() ? '\0' : rest_.front(); }
  bool take(char c) {
    if (front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  void skip_blanks() {
    while (take(' ')) {
    }
  }
  // At most `most` digits; returns value and number of digits.
  std::optional<std::pair<int, int>> number(int most) {
    int digits = 0, value = 0;
    while (digits < most && is_digit(front())) {
      value = 10 * value + (front() - '0');
      ++digits;
      rest_.remove_prefix(1);
    }
    if (digits == 0 || is_digit(front())) return {};
    return std::pair{value, digits};
  }
  std::string word() {
    std::size_t end = 0;
    while (end < rest_.size() &&
           (static_cast<unsigned char>(rest_[end]) >= 0x80 || (rest_[end] >= 'a' && rest_[end] <= 'z') ||
            (rest_[end] >= 'A' && rest_[end] <= 'Z')))
      ++end;
    std::string taken = lower_case(rest_.substr(0, end));
    rest_.remove_prefix(end);
    return taken;
  }
  double fraction() {
    std::size_t end = 0;
    while (end < rest_.size() && is_digit(rest_[end])) ++end;
    const std::string digits = "0." + std::string(rest_.substr(0, end));
    rest_.remove_prefix(end);
    double value = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return value;
  }

 private:
  std::string_view rest_;
};

// English and German, by their first letters.
int month_named(const std::string& word) {
  static constexpr std::array<std::pair<std::string_view, int>, 17> names{{{"jan", 1},
                                                                           {"feb", 2},
                                                                           {"mar", 3},
                                                                           {"m\xC3\xA4r", 3},
                                                                           {"mrz", 3},
                                                                           {"apr", 4},
                                                                           {"may", 5},
                                                                           {"mai", 5},
                                                                           {"jun", 6},
                                                                           {"jul", 7},
                                                                           {"aug", 8},
                                                                           {"sep", 9},
                                                                           {"oct", 10},
                                                                           {"okt", 10},
                                                                           {"nov", 11},
                                                                           {"dec", 12},
                                                                           {"dez", 12}}};
  for (const auto& [name, month] : names)
    if (word.starts_with(name) && word.size() <= 10) return month;
  return 0;
}

bool is_leap(std::int64_t year) { return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0); }

bool is_in_calendar(const DateParts& date) {
  static constexpr std::array<int, 12> days{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  if (date.month < 1 || date.month > 12 || date.day < 1 || date.year < 1) return false;
  const int longest =
      date.month == 2 && is_leap(date.year) ? 29 : days[static_cast<std::size_t>(date.month - 1)];
  return date.day <= longest;
}

// Two digits: this century.
int whole_year(std::pair<int, int> year) { return year.second <= 2 ? 2000 + year.first : year.first; }

// Reads a leading date. False without one; stamp.kind holds other errors.
bool read_date(StampReader& in, DateOrder order, TimeStamp& stamp) {
  DateParts date;
  StampReader trial = in;
  const auto first = trial.number(4);
  if (!first) return false;
  const char mark = trial.front();
  const bool by_name = mark == ' ' || mark == '-' || mark == '.';
  if (StampReader named = trial;
      by_name && first->second <= 2 && (named.take(mark), named.skip_blanks(), true))
    if (const int month = month_named(named.word()); month > 0) {
      named.take('.');
      if (!named.take(mark)) named.skip_blanks();
      const auto year = named.number(4);
      if (!year || (year->second != 2 && year->second != 4)) return false;
      date = {whole_year(*year), month, first->first};
      in = named;
      stamp.kind = is_in_calendar(date) ? TimeStamp::Kind::known : TimeStamp::Kind::not_in_calendar;
      stamp.seconds = 86400 * days_to_date(date.year, date.month, date.day);
      return true;
    }
  if ((mark != '-' && mark != '/' && mark != '.') || !trial.take(mark)) return false;
  const auto second = trial.number(2);
  if (!second || !trial.take(mark)) return false;
  const auto third = trial.number(4);
  if (!third) return false;
  if (first->second == 4) {
    if (third->second > 2) return false;
    date = {first->first, second->first, third->first};
  } else {
    if (first->second > 2 || (third->second != 2 && third->second != 4)) return false;
    const int year = whole_year(*third);
    bool day_first = true;
    if (mark != '.') {
      stamp.may_be_day_first = second->first <= 12;
      stamp.may_be_month_first = first->first <= 12;
      if (order == DateOrder::unsaid && stamp.may_be_day_first && stamp.may_be_month_first) {
        stamp.kind = TimeStamp::Kind::unsaid_order;
        in = trial;
        return true;
      }
      day_first = order == DateOrder::unsaid ? stamp.may_be_day_first : order == DateOrder::day_first;
    }
    date = day_first ? DateParts{year, second->first, first->first}
                     : DateParts{year, first->first, second->first};
  }
  in = trial;
  stamp.kind = is_in_calendar(date) ? TimeStamp::Kind::known : TimeStamp::Kind::not_in_calendar;
  if (stamp.kind == TimeStamp::Kind::known)
    stamp.seconds = 86400 * days_to_date(date.year, date.month, date.day);
  return true;
}

// Reads the remaining time of day; false without one.
bool read_clock(StampReader& in, ClockForm clock, TimeStamp& stamp) {
  using Kind = TimeStamp::Kind;
  const auto first = in.number(stamp.dated ? 2 : 5);
  if (!first || !in.take(':')) return false;
  const auto second = in.number(2);
  if (!second || second->second != 2) return false;
  int hours = first->first, minutes = second->first, seconds = 0;
  const bool three = in.take(':');
  if (three) {
    const auto third = in.number(2);
    if (!third || third->second != 2) return false;
    seconds = third->first;
  }
  double fraction = 0;
  const bool fractional = in.take('.') || in.take(',');
  if (fractional) {
    if (!is_digit(in.front())) return false;
    fraction = in.fraction();
  }
  in.skip_blanks();
  bool twelve = false, after_noon = false;
  if (StampReader trial = in; true) {
    std::string word = trial.word();
    if (word == "a" && trial.take('.')) word = trial.word() == "m" ? "am" : "";
    if (word == "p" && trial.take('.')) word = trial.word() == "m" ? "pm" : "";
    if (word == "am" || word == "pm") {
      trial.take('.');
      twelve = true;
      after_noon = word == "pm";
      in = trial;
      in.skip_blanks();
    }
  }
  if (!three && fractional && stamp.dated) return false;
  const bool of_day = stamp.dated || twelve;
  if (!three && !of_day) {
    // "10:30.5" ends with seconds.
    const ClockForm form = fractional ? ClockForm::minutes_seconds : clock;
    if (form == ClockForm::unsaid) stamp.kind = Kind::unsaid_clock;
    if (form == ClockForm::minutes_seconds) {
      seconds = minutes;
      minutes = hours;
      hours = 0;
    }
  }
  if (stamp.kind == Kind::none) stamp.kind = Kind::known;
  const bool end_of_day = hours == 24 && minutes == 0 && seconds == 0 && fraction == 0;
  const bool in_day = twelve ? hours >= 1 && hours <= 12 : hours < 24 || end_of_day || !stamp.dated;
  const bool minutes_alone = !three && !of_day && hours == 0;
  if (!in_day || (minutes > 59 && !minutes_alone) || seconds > 60)
    if (stamp.kind == Kind::known) stamp.kind = Kind::not_in_calendar;
  if (twelve) hours = hours % 12 + (after_noon ? 12 : 0);
  stamp.seconds += 3600LL * hours + 60LL * minutes + seconds;
  stamp.fraction = fraction;
  return true;
}

// Final "Z", "+01:00", "-0530", "+01".
bool read_zone(StampReader& in, TimeStamp& stamp) {
  if (in.at_end()) return true;
  stamp.zoned = true;
  if (in.take('Z') || in.take('z')) return in.at_end();
  const bool east = in.front() == '+';
  if (!in.take('+') && !in.take('-')) return false;
  const std::string_view rest = in.rest();
  StampReader digits = in;
  int hours = 0, minutes = 0;
  if (rest.size() == 4 && rest.find(':') == std::string_view::npos) {
    const auto all = digits.number(4);
    if (!all) return false;
    hours = all->first / 100;
    minutes = all->first % 100;
  } else {
    const auto h = digits.number(2);
    if (!h || h->second != 2) return false;
    hours = h->first;
    if (digits.take(':')) {
      const auto m = digits.number(2);
      if (!m || m->second != 2) return false;
      minutes = m->first;
    }
  }
  if (!digits.at_end() && rest.size() != 4) return false;
  if (hours > 14 || minutes > 59) return false;
  stamp.seconds -= (east ? 1 : -1) * (3600LL * hours + 60LL * minutes);
  return true;
}

}  // namespace

std::int64_t days_to_date(std::int64_t year, int month, int day) {
  // Years from March have their leap day last; 400 years are 146097 days.
  const std::int64_t y = month <= 2 ? year - 1 : year;
  const std::int64_t era = (y >= 0 ? y : y - 399) / 400, in_era = y - 400 * era;
  const std::int64_t in_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  return 146097 * era + 365 * in_era + in_era / 4 - in_era / 100 + in_year - 719468;
}

TimeStamp read_time_stamp(std::string_view text, DateOrder order, ClockForm clock) {
  text = trimmed(text);
  constexpr std::size_t longest = 64;
  TimeStamp stamp;
  if (text.empty() || text.size() > longest || !is_digit(text.front())) return stamp;
  StampReader in(text);
  // ISO 8601 basic format, "20261123T100000".
  if (text.size() >= 9 && text[8] == 'T') {
    std::string extended;
    for (std::size_t k = 0; k < text.size(); ++k) {
      if (k == 4 || k == 6) extended += '-';
      if ((k == 11 || k == 13) && is_digit(text[k])) extended += ':';
      extended += text[k];
    }
    if (text.find(':') == std::string_view::npos &&
        text.substr(0, 8).find_first_not_of("0123456789") == std::string_view::npos)
      return read_time_stamp(extended, order, clock);
  }
  stamp.dated = read_date(in, order, stamp);
  if (stamp.dated) {
    if (in.at_end()) return stamp;
    if (!in.take('T') && !in.take(' ') && !in.take(',') && !in.take(';')) return {};
    in.take('T');
    in.skip_blanks();
    if (in.at_end()) return {};
  }
  const TimeStamp::Kind date = stamp.kind;
  if (!read_clock(in, clock, stamp) || !read_zone(in, stamp)) return {};
  if (stamp.dated && date != TimeStamp::Kind::known) stamp.kind = date;
  return stamp;
}

}  // namespace asperity
