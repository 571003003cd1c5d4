// SPDX-License-Identifier: GPL-3.0-or-later
// A unit is numerator / denominator × 10^ten, exact where possible. The power of ten is inserted into the
// number's text, so "250 um" is the double nearest to 250e-6, with one rounding.
#include "engine/core/quantity.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

struct Unit {
  std::string_view name;
  Dimension dimension;
  double numerator = 1, denominator = 1;
  int ten = 0;
};

// lb in 1e-13 N: 0.45359237 kg × 9.80665 m/s². in2 in 1e-8 m²: (25.4 mm)².
constexpr double lb = 44482216152605, in2 = 64516, lb_kg = 45359237;
constexpr double vickers = 9806650;  // Pa; HV counts kgf/mm²

// The k of kip, m of mil and a of atm are no prefixes. Common units first: of equally near names the first is
// suggested.
constexpr Unit units[] = {
    {"m", dimension::length, 1, 1, 0},        {"um", dimension::length, 1, 1, -6},
    {"\u00B5m", dimension::length, 1, 1, -6}, {"\u03BCm", dimension::length, 1, 1, -6},
    {"mm", dimension::length, 1, 1, -3},      {"nm", dimension::length, 1, 1, -9},
    {"pm", dimension::length, 1, 1, -12},     {"cm", dimension::length, 1, 1, -2},
    {"km", dimension::length, 1, 1, 3},       {"in", dimension::length, 254, 1, -4},
    {"g", dimension::mass, 1, 1, -3},         {"kg", dimension::mass, 1, 1, 0},
    {"mg", dimension::mass, 1, 1, -6},        {"ug", dimension::mass, 1, 1, -9},
    {"\u00B5g", dimension::mass, 1, 1, -9},   {"\u03BCg", dimension::mass, 1, 1, -9},
    {"t", dimension::mass, 1, 1, 3},          {"s", dimension::time, 1, 1, 0},
    {"min", dimension::time, 60, 1, 0},       {"h", dimension::time, 3600, 1, 0},
    {"ms", dimension::time, 1, 1, -3},        {"us", dimension::time, 1, 1, -6},
    {"\u00B5s", dimension::time, 1, 1, -6},   {"\u03BCs", dimension::time, 1, 1, -6},
    {"ns", dimension::time, 1, 1, -9},        {"N", dimension::force, 1, 1, 0},
    {"kN", dimension::force, 1, 1, 3},        {"MN", dimension::force, 1, 1, 6},
    {"mN", dimension::force, 1, 1, -3},       {"uN", dimension::force, 1, 1, -6},
    {"\u00B5N", dimension::force, 1, 1, -6},  {"\u03BCN", dimension::force, 1, 1, -6},
    {"nN", dimension::force, 1, 1, -9},       {"pN", dimension::force, 1, 1, -12},
    {"Pa", dimension::pressure, 1, 1, 0},     {"MPa", dimension::pressure, 1, 1, 6},
    {"GPa", dimension::pressure, 1, 1, 9},    {"kPa", dimension::pressure, 1, 1, 3},
    {"hPa", dimension::pressure, 1, 1, 2},    {"bar", dimension::pressure, 1, 1, 5},
    {"mbar", dimension::pressure, 1, 1, 2},   {"J", dimension::energy, 1, 1, 0},
    {"kJ", dimension::energy, 1, 1, 3},       {"mJ", dimension::energy, 1, 1, -3},
    {"uJ", dimension::energy, 1, 1, -6},      {"\u00B5J", dimension::energy, 1, 1, -6},
    {"\u03BCJ", dimension::energy, 1, 1, -6}, {"nJ", dimension::energy, 1, 1, -9},
    {"pJ", dimension::energy, 1, 1, -12},     {"fJ", dimension::energy, 1, 1, -15},
    {"rad", dimension::angle, 1, 1, 0},       {"mrad", dimension::angle, 1, 1, -3},
    {"deg", dimension::angle, pi, 180, 0},    {"\u00B0", dimension::angle, pi, 180, 0},
    {"turn", dimension::angle, 2 * pi, 1, 0}, {"Hz", dimension::frequency, 1, 1, 0},
    {"kHz", dimension::frequency, 1, 1, 3},   {"MHz", dimension::frequency, 1, 1, 6},
    {"%", dimension::number, 1, 1, -2},       {"1", dimension::number, 1, 1, 0},
    {"kgf", dimension::force, 980665, 1, -5}, {"tf", dimension::force, 980665, 1, -2},
    {"lbf", dimension::force, lb, 1, -13},    {"kip", dimension::force, lb, 1, -10},
    {"daN", dimension::force, 1, 1, 1},       {"psi", dimension::pressure, lb, in2, -5},
    {"atm", dimension::pressure, 101325},     {"ksi", dimension::pressure, lb, in2, -2},
    {"rev", dimension::angle, 2 * pi, 1, 0},  {"kp", dimension::force, 980665, 1, -5},
    {"HV", dimension::pressure, vickers},     {"inch", dimension::length, 254, 1, -4},
    {"mil", dimension::length, 254, 1, -7},   {"thou", dimension::length, 254, 1, -7},
    {"uin", dimension::length, 254, 1, -10},  {"ft", dimension::length, 3048, 1, -4},
    {"lb", dimension::mass, lb_kg, 1, -8},
};

// For messages: at most 40 bytes, one line, whole UTF-8 characters.
std::string shown(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string result = "\"";
  std::size_t k = 0;
  while (k < text.size()) {
    const auto lead = static_cast<unsigned char>(text[k]);
    const std::size_t bytes = lead < 0x80                   ? 1
                              : lead >= 0xC2 && lead < 0xE0 ? 2
                              : lead >= 0xE0 && lead < 0xF0 ? 3
                                                            : 0;
    bool whole = bytes > 0 && k + bytes <= text.size() && lead >= 0x20 && lead != 0x7F;
    for (std::size_t b = 1; whole && b < bytes; ++b)
      whole = (static_cast<unsigned char>(text[k + b]) & 0xC0) == 0x80;
    const std::size_t used = whole ? bytes : 1;
    if (k + used > longest) break;
    result += whole ? text.substr(k, used) : std::string_view("?");
    k += used;
  }
  return result + (k < text.size() ? "...\"" : "\"");
}

std::string shown_name(std::string_view name) {
  const std::string text = shown(name);
  return quoted(text.substr(1, text.size() - 2));
}

[[noreturn]] void refuse(std::string_view text, const std::string& what, std::string hint = {}) {
  throw Error(ErrorCode::bad_unit, shown(text) + ": " + what, std::move(hint));
}

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text), rest_(text) {}

  void read_number() {
    skip_space();
    const std::string_view start = rest_;
    if (!rest_.empty() && (rest_[0] == '+' || rest_[0] == '-')) rest_.remove_prefix(1);
    const std::size_t whole = skip_digits();
    std::size_t fraction = 0;
    if (!rest_.empty() && rest_[0] == '.') {
      rest_.remove_prefix(1);
      fraction = skip_digits();
    }
    if (whole + fraction == 0)
      refuse(text_, "no number to begin with", "write a number and a unit, such as \"250 um\"");
    mantissa_ = start.substr(0, start.size() - rest_.size());
    if (mantissa_[0] == '+') mantissa_.remove_prefix(1);
    read_exponent();
    if (!rest_.empty() && rest_[0] == ',')
      refuse(text_, "a comma inside a number", "write the decimal sign as a point, such as \"1.5 mm\"");
  }

  void take_number_one() { mantissa_ = "1"; }

  void read_unit() {
    bool divide = false, wanted = false;
    for (skip_space(); !rest_.empty(); skip_space()) {
      read_factor(divide);
      wanted = divide = false;
      skip_space();
      if (take("*") || take("\u00B7")) {
        wanted = true;
      } else if (take("/")) {
        wanted = divide = true;
      }
    }
    if (wanted) refuse(text_, "a unit is missing at the end");
  }

  Quantity result() const {
    const auto out_of_range = [&] { refuse(text_, "the value is outside the range of numbers"); };
    Quantity quantity;
    for (const auto& [member, power] : {std::pair{&Dimension::length, powers_[0]},
                                        {&Dimension::mass, powers_[1]},
                                        {&Dimension::time, powers_[2]},
                                        {&Dimension::angle, powers_[3]}})
      quantity.dimension.*member = static_cast<std::int8_t>(power);
    const bool decimal = numerator_ == denominator_;
    const auto read = [&](long exponent) {
      const std::string number = std::string(mantissa_) + "e" + std::to_string(exponent);
      double value = 0;
      const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
      if (error != std::errc{} || end != number.data() + number.size()) out_of_range();
      return value;
    };
    quantity.value = read(decimal ? exponent_ + ten_ : exponent_);
    if (!decimal) {
      quantity.value = quantity.value * numerator_ / denominator_;
      // Powers of ten up to 22 are exact doubles, so the division rounds once.
      quantity.value = ten_ < 0 ? quantity.value / elementary::pow(10.0, -ten_)
                                : quantity.value * elementary::pow(10.0, ten_);
    }
    if (!std::isfinite(quantity.value)) out_of_range();
    return quantity;
  }

  bool at_end() {
    skip_space();
    return rest_.empty();
  }

  void count_in(const Reader& unit) {
    numerator_ *= unit.denominator_;
    denominator_ *= unit.numerator_;
    ten_ -= unit.ten_;
  }

 private:
  bool take(std::string_view mark) {
    if (!rest_.starts_with(mark)) return false;
    rest_.remove_prefix(mark.size());
    return true;
  }

  void skip_space() {
    // Word processors put no-break and thin spaces before units.
    while (take(" ") || take("\t") || take("\u00A0") || take("\u202F") || take("\u2009")) {
    }
  }

  std::size_t skip_digits() {
    std::size_t n = 0;
    while (n < rest_.size() && rest_[n] >= '0' && rest_[n] <= '9') ++n;
    rest_.remove_prefix(n);
    return n;
  }

  // An e without digits begins a unit.
  void read_exponent() {
    std::size_t k = 1;
    if (rest_.size() > 1 && (rest_[1] == '+' || rest_[1] == '-')) k = 2;
    if (rest_.size() <= k || (rest_[0] != 'e' && rest_[0] != 'E') || rest_[k] < '0' || rest_[k] > '9') return;
    const bool negative = rest_[1] == '-';
    rest_.remove_prefix(k);
    constexpr long beyond_any_double = 100000000;
    for (const char c : rest_) {
      if (c < '0' || c > '9') break;
      exponent_ = std::min(exponent_ * 10 + (c - '0'), beyond_any_double);
    }
    skip_digits();
    if (negative) exponent_ = -exponent_;
  }

  std::size_t name_length() const {
    std::size_t n = 0;
    while (n < rest_.size()) {
      const char c = rest_[n];
      const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%' || c == '_';
      if (!letter && static_cast<unsigned char>(c) < 0x80) break;
      const std::string_view here = rest_.substr(n);
      if (here.starts_with("\u00B7") || here.starts_with("\u00A0") || here.starts_with("\u202F") ||
          here.starts_with("\u2009") || superscript(here).bytes > 0)
        break;
      ++n;
    }
    return n;
  }

  struct Superscript {
    std::size_t bytes = 0;
    int digit = 0;  // -1 for the minus sign
  };
  static Superscript superscript(std::string_view here) {
    static constexpr std::string_view digits[] = {"\u2070", "\u00B9", "\u00B2", "\u00B3", "\u2074",
                                                  "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    for (int d = 0; d < 10; ++d)
      if (here.starts_with(digits[d])) return {digits[d].size(), d};
    if (here.starts_with("\u207B")) return {3, -1};
    return {};
  }

  // "^2", "**-2", "²", "⁻³", or adjacent digits ("m2"); 1 if absent.
  int read_power() {
    constexpr int greatest = 9;
    const bool marked = take("^") || take("**");
    if (marked) skip_space();
    std::size_t digits = 0;
    int power = 0;
    bool negative = false;
    if (const Superscript first = superscript(rest_); !marked && first.bytes > 0) {
      if (first.digit < 0) {
        negative = true;
        rest_.remove_prefix(first.bytes);
      }
      for (Superscript s = superscript(rest_); s.bytes > 0 && s.digit >= 0; s = superscript(rest_)) {
        power = std::min(power * 10 + s.digit, greatest + 1);
        rest_.remove_prefix(s.bytes);
        ++digits;
      }
    } else {
      const bool sign =
          rest_.size() > 1 && (rest_[0] == '-' || rest_[0] == '+') && rest_[1] >= '0' && rest_[1] <= '9';
      if (sign) {
        negative = rest_[0] == '-';
        rest_.remove_prefix(1);
      }
      for (; !rest_.empty() && rest_[0] >= '0' && rest_[0] <= '9'; rest_.remove_prefix(1), ++digits)
        power = std::min(power * 10 + (rest_[0] - '0'), greatest + 1);
      if (digits == 0 && !marked) return 1;
    }
    if (digits == 0 || power > greatest || (!rest_.empty() && rest_[0] == '.'))
      refuse(text_, "a unit's power is not a whole number from -9 to 9");
    return negative ? -power : power;
  }

  void read_factor(bool divide) {
    std::string_view name;
    if (const std::size_t n = name_length(); n > 0) {
      name = rest_.substr(0, n);
      rest_.remove_prefix(n);
    } else if (rest_[0] == '1' && (rest_.size() == 1 || rest_[1] < '0' || rest_[1] > '9') &&
               !rest_.starts_with("1.")) {
      name = rest_.substr(0, 1);
      rest_.remove_prefix(1);
    } else if (rest_[0] == '(' || rest_[0] == ')') {
      refuse(text_, "brackets in a unit", "write every divisor after its own stroke, such as \"J/m^2/s\"");
    } else {
      refuse(text_, "cannot read a unit from " + shown(rest_));
    }
    const std::string_view known = name == "\u00B5in" || name == "\u03BCin" ? "uin" : name;
    const auto* const unit =
        std::find_if(std::begin(units), std::end(units), [&](const Unit& u) { return u.name == known; });
    if (unit == std::end(units)) refuse_unknown(name);
    // "640 HV10" (ISO 6507): the digits are the test load in kgf, not a power.
    if (name == "HV" && skip_digits() > 0 && take(".")) skip_digits();
    const int power = name == "1" ? 1 : read_power();
    add(*unit, divide ? -power : power);
  }

  [[noreturn]] void refuse_unknown(std::string_view name) const {
    // In kgf/mm² like HV, but over other indenter areas.
    if (name == "HK" || name == "HB" || name == "HBW")
      refuse(text_, shown_name(name) + " is a scale of hardness, and hardness is a pressure",
             "write " + std::string(name) + " x 9.807 MPa: 100 " + std::string(name) + " is \"980.7 MPa\"");
    std::vector<std::string> names;
    for (const Unit& unit : units)
      if (unit.name != "1" && (unit.name.front() == name.front())) names.emplace_back(unit.name);
    for (const Unit& unit : units)
      if (unit.name != "1" && (unit.name.front() != name.front())) names.emplace_back(unit.name);
    const std::string guess = did_you_mean(name, names);
    refuse(text_, "unknown unit " + shown_name(name) + guess,
           guess.empty() ? "units are products of m, g, s, min, N, Pa, bar, J, rad, deg, Hz, % with "
                           "prefixes, such as um, MPa/um, kg m^-3"
                         : "");
  }

  void add(const Unit& unit, int power) {
    for (int k = 0; k < std::abs(power); ++k) {
      numerator_ *= power > 0 ? unit.numerator : unit.denominator;
      denominator_ *= power > 0 ? unit.denominator : unit.numerator;
    }
    ten_ += power * unit.ten;
    const Dimension& d = unit.dimension;
    const int change[4] = {d.length, d.mass, d.time, d.angle};
    constexpr int greatest = 100;
    bool readable =
        std::abs(ten_) <= 4 * greatest && std::isfinite(numerator_) && std::isfinite(denominator_);
    for (int k = 0; k < 4; ++k) {
      powers_[k] += power * change[k];
      readable = readable && std::abs(powers_[k]) <= greatest;
    }
    if (!readable) refuse(text_, "the powers of its units are too high");
  }

  std::string_view text_, rest_, mantissa_;
  long exponent_ = 0;
  double numerator_ = 1, denominator_ = 1;
  int ten_ = 0;
  int powers_[4] = {0, 0, 0, 0};
};

}  // namespace

Quantity parse_quantity(std::string_view text) {
  Reader reader(text);
  reader.read_number();
  reader.read_unit();
  return reader.result();
}

Quantity parse_unit(std::string_view text) {
  // Table headers write "-" for no unit.
  if (text == "-") text = "";
  Reader reader(text);
  reader.take_number_one();
  reader.read_unit();
  return reader.result();
}

double parse_quantity_as(std::string_view text, Dimension wanted) {
  const Quantity quantity = parse_quantity(text);
  if (quantity.dimension == wanted) return quantity.value;
  const std::string example = "\"" + example_quantity(wanted) + "\"";
  if (quantity.dimension == dimension::number)
    refuse(text, "no unit where " + describe(wanted) + " is wanted",
           "write " + describe(wanted) + " such as " + example + ", or a number without quotes in " +
               si_unit(wanted));
  refuse(text, describe(quantity.dimension) + " where " + describe(wanted) + " is wanted",
         wanted == dimension::number ? "write a plain number such as " + example
                                     : "write it such as " + example);
}

double parse_quantity_in(std::string_view text, std::string_view unit) {
  if (unit == "-") unit = "";
  Reader reader(text), one(unit);
  reader.read_number();
  const bool has_unit = !reader.at_end();
  reader.read_unit();
  one.take_number_one();
  one.read_unit();
  const Dimension given = reader.result().dimension, wanted = one.result().dimension;
  // "10" in a column "%" may mean 10 % or a factor of ten.
  const bool untold = !has_unit && !unit.empty() && unit != "1";
  if (given != wanted || untold) {
    const std::string in = unit.empty() ? "without a unit" : "in " + std::string(unit);
    refuse(text, describe(given) + " where a number " + in + " is wanted",
           unit.empty() ? "give a plain number" : "write it such as \"1 " + std::string(unit) + "\"");
  }
  reader.count_in(one);
  return reader.result().value;
}

}  // namespace asperity
