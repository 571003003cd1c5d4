// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/time_stamp.hpp"

#include <charconv>
#include <chrono>
#include <optional>
#include <string>

#include "engine/core/files/text_table.hpp"

namespace asperity {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) {
  return static_cast<unsigned char>(c) >= 0x80 || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

struct Digits {
  int value = 0;
  std::size_t count = 0;
};

class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}
  bool at_end() const { return rest_.empty(); }
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
  // All digits, at most `most`.
  std::optional<Digits> number(std::size_t most) {
    const std::string digits = front_of(is_digit);
    if (digits.empty() || digits.size() > most) return {};
    return Digits{std::stoi(digits), digits.size()};
  }
  bool two_digits(int& value) {
    if (rest_.size() < 2 || !is_digit(rest_[0]) || !is_digit(rest_[1])) return false;
    value = 10 * (rest_[0] - '0') + (rest_[1] - '0');
    rest_.remove_prefix(2);
    return true;
  }
  bool fraction(double& value) {
    const std::string digits = "0." + front_of(is_digit);
    std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return digits.size() > 2;
  }
  std::string word() { return lower_case(front_of(is_letter)); }

 private:
  std::string front_of(bool (*belongs)(char)) {
    std::string taken;
    for (; !rest_.empty() && belongs(rest_.front()); rest_.remove_prefix(1)) taken += rest_.front();
    return taken;
  }
  std::string_view rest_;
};

// English and German, by first letters; else 0.
int month_named(const std::string& word) {
  constexpr std::string_view english = "janfebmaraprmayjunjulaugsepoctnovdec",
                             german = "janfebmrzaprmaijunjulaugsepoktnovdez";
  if (word.size() < 3 || word.size() > 10) return 0;
  if (word.starts_with("m\xC3\xA4r")) return 3;
  for (int month = 0; month < 12; ++month)
    for (const std::string_view names : {english, german})
      if (word.starts_with(names.substr(3 * static_cast<std::size_t>(month), 3))) return month + 1;
  return 0;
}

// Two digits: this century.
int whole_year(const Digits& year) { return year.count <= 2 ? 2000 + year.value : year.value; }

void set_date(TimeStamp& stamp, int year, int month, int day) {
  using namespace std::chrono;
  const year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                            std::chrono::day(static_cast<unsigned>(day))};
  const bool exists = year > 0 && date.ok();
  stamp.kind = exists ? TimeStamp::Kind::known : TimeStamp::Kind::not_in_calendar;
  if (exists) stamp.seconds = sys_seconds(sys_days(date)).time_since_epoch().count();
}

// False without a leading date; stamp.kind holds other errors.
bool read_date(Scanner& in, DateOrder order, TimeStamp& stamp) {
  Scanner at = in;
  const auto first = at.number(4);
  const char mark = at.front();
  if (!first || std::string_view("-/. ").find(mark) == std::string_view::npos) return false;
  at.take(mark);
  if (Scanner named = at; mark != '/' && first->count <= 2) {
    named.skip_blanks();
    if (const int month = month_named(named.word()); month > 0) {
      named.take('.');
      if (!named.take(mark)) named.skip_blanks();
      const auto year = named.number(4);
      if (!year || (year->count != 2 && year->count != 4)) return false;
      set_date(stamp, whole_year(*year), month, first->value);
      in = named;
      return true;
    }
  }
  const auto second = at.number(2);
  if (mark == ' ' || !second || !at.take(mark)) return false;
  const auto third = at.number(4);
  if (!third) return false;
  in = at;
  if (first->count == 4) {
    set_date(stamp, first->value, second->value, third->value);
    return third->count <= 2;
  }
  if (first->count > 2 || (third->count != 2 && third->count != 4)) return false;
  if (mark != '.') {
    stamp.may_be_day_first = second->value <= 12;
    stamp.may_be_month_first = first->value <= 12;
    if (order == DateOrder::unsaid && stamp.may_be_day_first && stamp.may_be_month_first) {
      stamp.kind = TimeStamp::Kind::unsaid_order;
      return true;
    }
  }
  const bool day_first =
      mark == '.' || (order == DateOrder::unsaid ? stamp.may_be_day_first : order == DateOrder::day_first);
  set_date(stamp, whole_year(*third), (day_first ? second : first)->value,
           (day_first ? first : second)->value);
  return true;
}

// True for "pm" or "p.m.", false for am.
std::optional<bool> read_half_of_day(Scanner& in) {
  Scanner at = in;
  std::string word = at.word();
  if ((word == "a" || word == "p") && at.take('.')) word += at.word();
  if (word != "am" && word != "pm") return {};
  at.take('.');
  at.skip_blanks();
  in = at;
  return word == "pm";
}

// False without a time of day.
bool read_clock(Scanner& in, ClockForm clock, TimeStamp& stamp) {
  using Kind = TimeStamp::Kind;
  const auto first = in.number(stamp.dated ? 2 : 5);
  int minutes = 0, seconds = 0;
  if (!first || !in.take(':') || !in.two_digits(minutes)) return false;
  int hours = first->value;
  const bool three = in.take(':');
  if (three && !in.two_digits(seconds)) return false;
  const bool fractional = in.take('.') || in.take(',');
  if (fractional && ((!three && stamp.dated) || !in.fraction(stamp.fraction))) return false;
  in.skip_blanks();
  const std::optional<bool> after_noon = read_half_of_day(in);
  const bool twelve = after_noon.has_value(), two_alone = !three && !stamp.dated && !twelve;
  Kind kind = Kind::known;
  if (two_alone) {
    // "10:30.5" ends with seconds.
    const ClockForm form = fractional ? ClockForm::minutes_seconds : clock;
    if (form == ClockForm::unsaid) kind = Kind::unsaid_clock;
    if (form == ClockForm::minutes_seconds) {
      seconds = minutes;
      minutes = hours;
      hours = 0;
    }
  }
  const bool end_of_day = hours == 24 && minutes == 0 && seconds == 0 && stamp.fraction == 0;
  const bool in_day = twelve ? hours >= 1 && hours <= 12 : hours < 24 || end_of_day || !stamp.dated;
  const bool in_hour = minutes <= 59 || (two_alone && hours == 0);
  if (kind == Kind::known && !(in_day && in_hour && seconds <= 60)) kind = Kind::not_in_calendar;
  if (!stamp.dated || stamp.kind == Kind::known) stamp.kind = kind;
  if (after_noon) hours = hours % 12 + (*after_noon ? 12 : 0);
  stamp.seconds += 3600LL * hours + 60LL * minutes + seconds;
  return true;
}

// Final "Z", "+01:00", "-0530", "+01".
bool read_zone(Scanner& in, TimeStamp& stamp) {
  if (in.at_end()) return true;
  stamp.zoned = true;
  if (in.take('Z') || in.take('z')) return in.at_end();
  const int sign = in.take('+') ? 1 : in.take('-') ? -1 : 0;
  int hours = 0, minutes = 0;
  if (sign == 0 || !in.two_digits(hours)) return false;
  if ((in.take(':') || !in.at_end()) && !in.two_digits(minutes)) return false;
  stamp.seconds -= sign * (3600LL * hours + 60LL * minutes);
  return in.at_end() && hours <= 14 && minutes <= 59;
}

}  // namespace

TimeStamp read_time_stamp(std::string_view text, DateOrder order, ClockForm clock) {
  text = trimmed(text);
  constexpr std::size_t longest = 64;
  if (text.empty() || text.size() > longest || !is_digit(text.front())) return {};
  // ISO 8601 basic format, "20261123T100000".
  if (text.size() >= 9 && text[8] == 'T' && text.find(':') == std::string_view::npos &&
      text.substr(0, 8).find_first_not_of("0123456789") == std::string_view::npos) {
    std::string extended(text);
    for (const std::size_t at : {13U, 11U, 6U, 4U})
      if (at < text.size() && is_digit(text[at])) extended.insert(at, at > 8 ? ":" : "-");
    return read_time_stamp(extended, order, clock);
  }
  TimeStamp stamp;
  Scanner in(text);
  stamp.dated = read_date(in, order, stamp);
  if (stamp.dated) {
    if (in.at_end()) return stamp;
    if (!in.take('T') && !in.take(' ') && !in.take(',') && !in.take(';')) return {};
    in.take('T');
    in.skip_blanks();
  } else {
    stamp = {};
    in = Scanner(text);
  }
  return read_clock(in, clock, stamp) && read_zone(in, stamp) ? stamp : TimeStamp{};
}

}  // namespace asperity
