// SPDX-License-Identifier: GPL-3.0-or-later
// A unit is numerator / denominator × 10^ten. The power of ten is inserted into the number's text, so "250
// um" rounds once.
#include "engine/core/quantity.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>

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

// kip, mil and atm have no prefix. Common units first: the first of equally near names is suggested.
constexpr Unit units[] = {
    {"m", dimension::length, 1, 1, 0},        {"um", dimension::length, 1, 1, -6},
    {"mm", dimension::length, 1, 1, -3},      {"nm", dimension::length, 1, 1, -9},
    {"pm", dimension::length, 1, 1, -12},     {"cm", dimension::length, 1, 1, -2},
    {"km", dimension::length, 1, 1, 3},       {"in", dimension::length, 254, 1, -4},
    {"g", dimension::mass, 1, 1, -3},         {"kg", dimension::mass, 1, 1, 0},
    {"mg", dimension::mass, 1, 1, -6},        {"ug", dimension::mass, 1, 1, -9},
    {"t", dimension::mass, 1, 1, 3},          {"s", dimension::time, 1, 1, 0},
    {"min", dimension::time, 60, 1, 0},       {"h", dimension::time, 3600, 1, 0},
    {"ms", dimension::time, 1, 1, -3},        {"us", dimension::time, 1, 1, -6},
    {"ns", dimension::time, 1, 1, -9},        {"N", dimension::force, 1, 1, 0},
    {"kN", dimension::force, 1, 1, 3},        {"MN", dimension::force, 1, 1, 6},
    {"mN", dimension::force, 1, 1, -3},       {"uN", dimension::force, 1, 1, -6},
    {"nN", dimension::force, 1, 1, -9},       {"pN", dimension::force, 1, 1, -12},
    {"Pa", dimension::pressure, 1, 1, 0},     {"MPa", dimension::pressure, 1, 1, 6},
    {"GPa", dimension::pressure, 1, 1, 9},    {"kPa", dimension::pressure, 1, 1, 3},
    {"hPa", dimension::pressure, 1, 1, 2},    {"bar", dimension::pressure, 1, 1, 5},
    {"mbar", dimension::pressure, 1, 1, 2},   {"J", dimension::energy, 1, 1, 0},
    {"kJ", dimension::energy, 1, 1, 3},       {"mJ", dimension::energy, 1, 1, -3},
    {"uJ", dimension::energy, 1, 1, -6},      {"nJ", dimension::energy, 1, 1, -9},
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
    {"lb", dimension::mass, lb_kg, 1, -8},    {"TPa", dimension::pressure, 1, 1, 12},
    {"day", dimension::time, 86400, 1, 0},    {"d", dimension::time, 86400, 1, 0},
    {"week", dimension::time, 604800, 1, 0},  {"micron", dimension::length, 1, 1, -6},
    {"\u00C5", dimension::length, 1, 1, -10}, {"angstrom", dimension::length, 1, 1, -10},
};

constexpr std::size_t longest_shown = 40;

std::string shown_name(std::string_view name) {
  const std::string text = shown(name, longest_shown);
  return quoted(text.substr(1, text.size() - 2));
}

[[noreturn]] void refuse(std::string_view text, const std::string& what, std::string hint = {}) {
  throw Error(ErrorCode::bad_unit, shown(text, longest_shown) + ": " + what, std::move(hint));
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
    if (take(".")) fraction = skip_digits();
    if (whole + fraction == 0)
      refuse(text_, "no number at its start", "write a number and a unit, such as \"250 um\"");
    mantissa_ = start.substr(0, start.size() - rest_.size());
    if (mantissa_[0] == '+') mantissa_.remove_prefix(1);
    read_exponent();
    if (rest_.empty() || (rest_[0] != ',' && rest_[0] != '\'')) return;
    std::string number(start);
    const bool thousands = rest_[0] == '\'' || number.rfind('.') + 1 > number.rfind(',') + 1;
    std::erase_if(number, [](char c) { return c == ',' || c == '\''; });
    refuse(text_, thousands ? "a separator of thousands" : "a comma inside a number",
           thousands ? "write \"" + number + "\"" : "write the decimal sign as a point, such as \"1.5 mm\"");
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
    if (wanted) refuse(text_, "a unit is missing at the end", "complete it, or drop the last sign");
  }

  Quantity result() const {
    const auto out_of_range = [&] {
      refuse(text_, "the value is outside the range of numbers", "check its exponent");
    };
    const auto power = [&](int k) { return static_cast<std::int8_t>(powers_[k]); };
    Quantity quantity{0, {power(0), power(1), power(2), power(3)}};
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
      // Powers of ten up to 22 are exact doubles: one rounding.
      quantity.value = ten_ < 0 ? quantity.value / elementary::pow(10.0, -ten_)
                                : quantity.value * elementary::pow(10.0, ten_);
    }
    if (!std::isfinite(quantity.value)) out_of_range();
    return quantity;
  }

  // Exact; "" for other than decimal units.
  std::string decimal_text() const {
    if (numerator_ != denominator_) return {};
    const bool negative = mantissa_.front() == '-';
    const std::string_view number = mantissa_.substr(negative ? 1 : 0);
    const std::size_t point = std::min(number.find('.'), number.size());
    std::string digits(number.substr(0, point));
    if (point < number.size()) digits += number.substr(point + 1);
    // Digits before the point.
    const long before = static_cast<long>(point) + exponent_ + ten_;
    constexpr long most = 21, zeros = 5;
    if (before > most || before < -zeros)
      return std::string(mantissa_) + "e" + std::to_string(exponent_ + ten_);
    if (before <= 0) digits.insert(0, static_cast<std::size_t>(1 - before), '0');
    const auto place = static_cast<std::size_t>(std::max(before, 1L));
    if (digits.size() < place) digits.append(place - digits.size(), '0');
    if (digits.size() > place) digits.insert(place, 1, '.');
    digits.erase(0, std::min(digits.find_first_not_of('0'), place - 1));
    return (negative ? "-" : "") + digits;
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
    // No-break and thin spaces of word processors.
    while (take(" ") || take("\t") || take("\u00A0") || take("\u202F") || take("\u2009")) {
    }
  }

  bool digit_at(std::size_t k) const { return k < rest_.size() && rest_[k] >= '0' && rest_[k] <= '9'; }

  std::size_t skip_digits() {
    std::size_t n = 0;
    while (digit_at(n)) ++n;
    rest_.remove_prefix(n);
    return n;
  }

  // An e without digits begins a unit.
  void read_exponent() {
    std::size_t k = 1;
    if (rest_.size() > 1 && (rest_[1] == '+' || rest_[1] == '-')) k = 2;
    if (!digit_at(k) || (rest_[0] != 'e' && rest_[0] != 'E')) return;
    const bool negative = rest_[1] == '-';
    rest_.remove_prefix(k);
    constexpr long beyond_any_double = 100000000;
    for (; digit_at(0); rest_.remove_prefix(1))
      exponent_ = std::min(exponent_ * 10 + (rest_[0] - '0'), beyond_any_double);
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
      if (digit_at(1) && (rest_[0] == '-' || rest_[0] == '+')) {
        negative = rest_[0] == '-';
        rest_.remove_prefix(1);
      }
      for (; digit_at(0); rest_.remove_prefix(1), ++digits)
        power = std::min(power * 10 + (rest_[0] - '0'), greatest + 1);
      if (digits == 0 && !marked) return 1;
    }
    if (digits == 0 || power > greatest || (!rest_.empty() && rest_[0] == '.'))
      refuse(text_, "the power of a unit is no whole number from -9 to 9", "write it such as \"kg m^-3\"");
    return negative ? -power : power;
  }

  void read_factor(bool divide) {
    std::string_view name;
    if (const std::size_t n = name_length(); n > 0) {
      name = rest_.substr(0, n);
      rest_.remove_prefix(n);
    } else if (rest_[0] == '1' && !digit_at(1) && !rest_.starts_with("1.")) {
      name = rest_.substr(0, 1);
      rest_.remove_prefix(1);
    } else if (rest_[0] == '(' || rest_[0] == ')') {
      refuse(text_, "brackets in a unit", "write every divisor after its own stroke, such as \"J/m^2/s\"");
    } else {
      refuse(text_, "cannot read a unit from " + shown(rest_, longest_shown));
    }
    std::string known(name);
    if (known.starts_with("\u00B5") || known.starts_with("\u03BC")) known.replace(0, 2, "u");
    const auto* const unit = std::ranges::find(units, known, &Unit::name);
    if (unit == std::end(units)) refuse_unknown(name);
    // "640 HV10" (ISO 6507): test load in kgf, not a power.
    if (name == "HV" && skip_digits() > 0 && take(".")) skip_digits();
    const int power = name == "1" ? 1 : read_power();
    add(*unit, divide ? -power : power);
  }

  [[noreturn]] void refuse_unknown(std::string_view name) const {
    // In kgf/mm², but over other indenter areas.
    if (name == "HK" || name == "HB" || name == "HBW")
      refuse(text_, shown_name(name) + " is a scale of hardness, and hardness is a pressure",
             "write " + std::string(name) + " x 9.807 MPa: 100 " + std::string(name) + " is \"980.7 MPa\"");
    if (name == "rpm") refuse(text_, "unknown unit `rpm`", "60 rpm is \"1 Hz\" or \"60 rev/min\"");
    if (name == "K" || name == "C" || name == "\u00B0C")
      refuse(text_, "temperatures have no unit", "write a plain number in K: 293.15 for 20 \u00B0C");
    std::vector<std::string> names;
    for (const Unit& unit : units)
      if (unit.name != "1") names.emplace_back(unit.name);
    std::stable_partition(names.begin(), names.end(),
                          [&](const auto& known) { return known.front() == name.front(); });
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

struct Kind {
  // `shown`: display units, smallest first; none: only the SI unit.
  Kind(Dimension of, std::string_view called, std::string_view such_as, std::string_view si,
       const char* shown)
      : dimension(of), name(called), example(such_as), si_unit(si) {
    std::istringstream names(shown);
    for (std::string unit; names >> unit;) display.push_back({unit, parse_unit(unit).value});
  }
  Dimension dimension;
  std::string_view name, example, si_unit;
  std::vector<DisplayUnit> display;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {dimension::number, "a plain number", "0.5", "", ""},
      {dimension::length, "a length", "250 um", "m", "pm nm um mm m km"},
      {dimension::area, "an area", "1 mm^2", "m^2", "nm^2 um^2 mm^2 m^2"},
      {dimension::volume, "a volume", "20 um^3", "m^3", "nm^3 um^3 mm^3 m^3"},
      {dimension::mass, "a mass", "4.3 g", "kg", "ug mg g kg t"},
      {dimension::time, "a time", "10 min", "s", "ns us ms s"},
      {dimension::angle, "an angle", "37 deg", "rad", "deg"},
      {dimension::force, "a force", "5 N", "N", "pN nN uN mN N kN MN"},
      {dimension::pressure, "a pressure", "152.78 MPa", "Pa", "Pa kPa MPa GPa"},
      {{1, -1, 2, 0}, "an area per force", "1 um^2/mN", "1/Pa", "1/TPa 1/GPa 1/MPa 1/kPa 1/Pa"},
      {dimension::stiffness, "a stiffness per area", "80 MPa/um", "Pa/m",
       "Pa/m kPa/m MPa/m GPa/m MPa/um GPa/um"},
      {dimension::energy, "an energy", "1 nJ", "J", "fJ pJ nJ uJ mJ J kJ"},
      {dimension::energy_per_area, "an energy per area", "50 mJ/m^2", "J/m^2", "uJ/m^2 mJ/m^2 J/m^2 kJ/m^2"},
      {dimension::density, "a density", "2830 kg/m^3", "kg/m^3", "kg/m^3"},
      {dimension::speed, "a speed", "50 um/s", "m/s", "nm/s um/s mm/s m/s"},
      {dimension::acceleration, "an acceleration", "9.81 m/s^2", "m/s^2", "m/s^2"},
      {dimension::frequency, "a frequency", "200 Hz", "Hz", "Hz kHz MHz"},
  };
  return all;
}

const Kind* find(Dimension dimension) {
  for (const Kind& kind : kinds())
    if (kind.dimension == dimension) return &kind;
  return nullptr;
}

DisplayUnit display_unit_for(double magnitude, Dimension dimension, int digits) {
  const Kind* kind = find(dimension);
  if (kind == nullptr || kind->display.empty() || !std::isfinite(magnitude)) return {si_unit(dimension), 1};
  const std::vector<DisplayUnit>& shown = kind->display;
  if (magnitude == 0) {
    const auto si = std::ranges::find(shown, 1, &DisplayUnit::factor);
    return si == shown.end() ? shown.front() : *si;
  }
  // Far below the smallest prefix: SI.
  DisplayUnit best = shown.front();
  if (shown.size() > 1 && magnitude < 1e-3 * best.factor) return {std::string(kind->si_unit), 1};
  // 1000 of one unit, as printed, becomes 1 of the next.
  const double prints_as_one = 1 - 0.5 * elementary::pow(10.0, -digits);
  for (const DisplayUnit& unit : shown)
    if (magnitude >= unit.factor * prints_as_one) best = unit;
  return best;
}

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
  // "10" in a column "%": 10 % or a factor of ten?
  const bool untold = !has_unit && !unit.empty() && unit != "1";
  if (given != wanted || untold) {
    const std::string in = unit.empty() ? "without a unit" : "in " + std::string(unit);
    refuse(text, describe(given) + " where a number " + in + " is wanted",
           unit.empty() ? "give a plain number" : "write it such as \"1 " + std::string(unit) + "\"");
  }
  reader.count_in(one);
  return reader.result().value;
}

namespace {

bool is_regular(double number) {
  return std::isfinite(number) && std::abs(number) >= std::numeric_limits<double>::min();
}

// `digits` must outlive the result.
Reader counted_in(std::string_view digits, std::string_view unit) {
  Reader reader(digits), one(unit);
  reader.read_number();
  one.take_number_one();
  one.read_unit();
  reader.count_in(one);
  return reader;
}

}  // namespace

double in_unit(double si, std::string_view unit) {
  if (unit == "-") return si;
  const double quotient = si / parse_unit(unit).value;
  if (unit.empty() || !is_regular(quotient)) return quotient;
  const std::string digits = format_exact(si);
  return counted_in(digits, unit).result().value;
}

double from_unit(double number, std::string_view unit) {
  if (unit.empty() || unit == "-" || !std::isfinite(number)) return number;
  return parse_quantity(format_exact(number) + " " + std::string(unit)).value;
}

std::string text_in_unit(double si, std::string_view unit) {
  const double number = in_unit(si, unit);
  if (unit.empty() || !is_regular(number)) return format_exact(number);
  constexpr int fewest_digits = 15, all_digits = 17;
  for (int digits = fewest_digits; digits <= all_digits; ++digits) {
    const double rounded = std::strtod(format_short(number, digits).c_str(), nullptr);
    if (from_unit(rounded, unit) == si) return format_exact(rounded);
  }
  // If no double reads back as `si`, use its own digits.
  const std::string digits = format_exact(si), exact = counted_in(digits, unit).decimal_text();
  return exact.empty() ? format_exact(number) : exact;
}

std::string describe(Dimension dimension) {
  if (const Kind* kind = find(dimension)) return std::string(kind->name);
  return "a quantity in " + si_unit(dimension);
}

std::optional<Dimension> dimension_named(std::string_view name) {
  for (const Kind& kind : kinds())
    if (kind.name.substr(kind.name.find(' ') + 1) == name) return kind.dimension;
  return {};
}

std::vector<std::string> dimension_names() {
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) names.emplace_back(kind.name.substr(kind.name.find(' ') + 1));
  return names;
}

std::string example_quantity(Dimension dimension) {
  if (const Kind* kind = find(dimension)) return std::string(kind->example);
  return "1 " + si_unit(dimension);
}

std::string si_unit(Dimension dimension) {
  if (const Kind* kind = find(dimension)) return std::string(kind->si_unit);
  std::string text;
  for (const auto& [symbol, power] : {std::pair{"kg", dimension.mass}, std::pair{"m", dimension.length},
                                      std::pair{"s", dimension.time}, std::pair{"rad", dimension.angle}}) {
    if (power == 0) continue;
    text += (text.empty() ? "" : " ") + std::string(symbol);
    if (power != 1) text += "^" + std::to_string(power);
  }
  return text;
}

std::vector<std::string> usual_units(Dimension dimension) {
  std::vector<std::string> names;
  if (const Kind* kind = find(dimension))
    for (const DisplayUnit& unit : kind->display) names.push_back(unit.name);
  if (names.empty() && !si_unit(dimension).empty()) names.push_back(si_unit(dimension));
  // Accepted, but never printed.
  if (dimension == dimension::time) names.insert(names.end(), {"min", "h"});
  if (dimension == dimension::angle) names.push_back("rad");
  return names;
}

std::string format_quantity(double value, Dimension dimension, int digits) {
  const DisplayUnit unit = display_unit_for(std::abs(value), dimension, digits);
  const std::string number = format_short(value / unit.factor, digits);
  return unit.name.empty() ? number : number + " " + unit.name;
}

DisplayUnit display_unit(double largest_magnitude, Dimension dimension) {
  constexpr int axis_digits = 6;
  return display_unit_for(std::abs(largest_magnitude), dimension, axis_digits);
}

}  // namespace asperity
