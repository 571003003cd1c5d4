// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/number_form.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/core/text.hpp"

namespace asperity {

namespace {

bool is_decimal_digit(char c) { return c >= '0' && c <= '9'; }

// Thousands separators of word processors: no-break and thin spaces.
constexpr std::array<std::string_view, 3> wide_blanks{"\u00A0", "\u202F", "\u2009"};

std::string with_plain_blanks(std::string_view text) {
  std::string plain(text);
  for (const std::string_view blank : wide_blanks)
    for (std::size_t k = plain.find(blank); k != std::string::npos; k = plain.find(blank))
      plain.replace(k, blank.size(), " ");
  return plain;
}

std::string with_plain_minus(std::string text) {
  constexpr std::string_view minus = "\u2212";
  if (text.starts_with(minus)) text.replace(0, minus.size(), "-");
  return text;
}

// Apostrophe of Swiss spreadsheets.
std::string with_plain_apostrophe(std::string text) {
  constexpr std::string_view curved = "\u2019";
  for (std::size_t k = text.find(curved); k != std::string::npos; k = text.find(curved))
    text.replace(k, curved.size(), "'");
  return text;
}

std::string_view without_sign(std::string_view text) {
  if (!text.empty() && (text.front() == '+' || text.front() == '-')) text.remove_prefix(1);
  return text;
}

// One to three digits, then groups of three.
bool parts_thousands(std::string_view whole, char sign) {
  std::size_t end = 0;
  while (end < whole.size() && is_decimal_digit(whole[end])) ++end;
  if (end == 0 || end > 3 || end == whole.size()) return false;
  for (; end < whole.size(); end += 4)
    if (whole[end] != sign || end + 4 > whole.size() || !is_decimal_digit(whole[end + 1]) ||
        !is_decimal_digit(whole[end + 2]) || !is_decimal_digit(whole[end + 3]))
      return false;
  return true;
}

bool looks_like_number(std::string_view text) {
  text = without_sign(text);
  return !text.empty() &&
         (is_decimal_digit(text.front()) ||
          ((text.front() == '.' || text.front() == ',') && text.size() > 1)) &&
         text.find_first_not_of("0123456789.,eE+-") == std::string_view::npos;
}

}  // namespace

std::string with_plain_signs(std::string_view text) {
  return with_plain_minus(with_plain_apostrophe(with_plain_blanks(text)));
}

std::optional<std::string> plain_number(std::string_view text, const NumberForm& form) {
  std::string plain = with_plain_minus(with_plain_apostrophe(std::string(text)));
  if (form.thousands == ' ') plain = with_plain_blanks(plain);
  if (form.thousands != '\0' && plain.find(form.thousands) != std::string::npos) {
    const std::string_view unsigned_text = without_sign(plain);
    const std::size_t end =
        std::min(unsigned_text.find_first_of(std::string("eE") + form.decimal), unsigned_text.size());
    if (!parts_thousands(unsigned_text.substr(0, end), form.thousands)) return {};
    std::erase(plain, form.thousands);
  }
  if (form.decimal == ',') {
    if (plain.find('.') != std::string::npos) return {};
    std::replace(plain.begin(), plain.end(), ',', '.');
  } else if (plain.find(',') != std::string::npos) {
    return {};
  }
  return plain;
}

bool looks_like_a_number(std::string_view cell) {
  std::string text = with_plain_signs(cell);
  std::erase_if(text, [](char c) { return c == ' ' || c == '\''; });
  std::ranges::replace(text, ',', '.');
  while (std::ranges::count(text, '.') > 1) text.erase(text.find('.'), 1);
  const CellKind kind = read_cell(text, Separator::comma).kind;
  return kind == CellKind::number || kind == CellKind::too_large;
}

TextCell read_number(std::string_view text, const NumberForm& form) {
  const std::optional<std::string> plain = plain_number(text, form);
  return plain ? read_cell(*plain, Separator::comma) : TextCell{};
}

void NumberEvidence::prove(char& sign, char found, std::string_view text, const std::string& place) {
  if (sign == '\0') sign = found;
  if (sign == found || !contradiction_.place.empty()) return;
  contradiction_ = {place, shown(text) + " has a " + (found == ',' ? "comma" : "point") + " for its " +
                               (&sign == &decimal_ ? "decimal sign" : "thousands") +
                               ", where the others have a " +
                               (sign == ','   ? "comma"
                                : sign == '.' ? "point"
                                              : "blank")};
}

void NumberEvidence::add(std::string_view cell, const std::string& place) {
  std::string joined = with_plain_signs(cell);
  const std::string_view number = without_sign(joined);
  const std::string_view before = number.substr(0, std::min(number.find_first_of(".,eE"), number.size()));
  for (const auto& [sign, unclear] :
       {std::pair{' ', &unclear_blank_}, std::pair{'\'', &unclear_apostrophe_}}) {
    if (!parts_thousands(before, sign)) continue;
    if (thousands_ != sign && unclear->place.empty()) *unclear = {place, shown(joined)};
    std::erase(joined, sign);
    break;
  }
  const std::string_view text = joined;
  if (!looks_like_number(text)) return;
  const std::string_view digits = without_sign(text);
  const auto commas = std::ranges::count(digits, ','), points = std::ranges::count(digits, '.');
  if (commas == 0 && points == 0) return;
  if (commas > 0 && points > 0) {
    const bool comma_last = digits.rfind(',') > digits.rfind('.');
    const char decimal = comma_last ? ',' : '.', thousands = comma_last ? '.' : ',';
    if ((comma_last ? commas : points) > 1) return;  // unreadable; the reader reports it
    prove(decimal_, decimal, text, place);
    prove(thousands_, thousands, text, place);
    return;
  }
  const char sign = commas > 0 ? ',' : '.';
  if (commas + points > 1) {
    if (parts_thousands(digits, sign)) prove(thousands_, sign, text, place);
    return;
  }
  const std::size_t at = digits.find(sign);
  const bool may_part =
      parts_thousands(digits.substr(0, std::min(digits.find_first_of("eE"), digits.size())), sign) &&
      digits.front() != '0' && digits.find_first_of("eE") == std::string_view::npos && at > 0;
  if (!may_part) return prove(decimal_, sign, text, place);
  Doubt& unclear = sign == ',' ? unclear_comma_ : unclear_point_;
  if (unclear.place.empty()) unclear = {place, shown(text)};
}

NumberForm NumberEvidence::form() const {
  NumberForm form;
  if (decimal_ != '\0')
    form.decimal = decimal_;
  else if (thousands_ == '.')
    form.decimal = ',';
  form.thousands = thousands_;
  return form;
}

std::optional<NumberEvidence::Doubt> NumberEvidence::doubt() const {
  if (!contradiction_.place.empty())
    return Doubt{contradiction_.place, contradiction_.finding + "; write all numbers in one way"};
  if (decimal_ != '\0' && decimal_ == thousands_)
    return Doubt{"the numbers", std::string("a ") + (decimal_ == ',' ? "comma" : "point") +
                                    " would be both the decimal sign and that of thousands"};
  if (!unclear_blank_.place.empty() && thousands_ != ' ')
    return Doubt{unclear_blank_.place,
                 unclear_blank_.finding +
                     " has a blank between its digits; thousands=\" \" says that it parts thousands"};
  if (!unclear_apostrophe_.place.empty() && thousands_ != '\'')
    return Doubt{unclear_apostrophe_.place,
                 unclear_apostrophe_.finding +
                     " has an apostrophe between its digits; thousands=\"'\" says that it parts thousands"};
  if (!unclear_comma_.place.empty() && decimal_ != ',' && thousands_ != ',')
    return Doubt{
        unclear_comma_.place,
        unclear_comma_.finding + (decimal_ == '.' ? " has a comma where the decimal sign is a point; "
                                                    "thousands=\",\" says that it parts thousands"
                                                  : " may be a decimal number or have its thousands parted; "
                                                    "decimal=\",\" or thousands=\",\" says which")};
  if (!unclear_point_.place.empty() && decimal_ == ',' && thousands_ != '.')
    return Doubt{
        unclear_point_.place,
        unclear_point_.finding +
            " has a point where the decimal sign is a comma; thousands=\".\" says that it parts thousands"};
  return {};
}

}  // namespace asperity
