// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/number_form.hpp"

#include <algorithm>
#include <array>

namespace asperity {

namespace {

bool is_decimal_digit(char c) { return c >= '0' && c <= '9'; }

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

std::string with_plain_signs(std::string_view text) {
  // No-break and thin spaces of word processors, apostrophes of Swiss spreadsheets.
  static constexpr std::array<std::pair<std::string_view, char>, 4> signs{
      {{"\u00A0", ' '}, {"\u202F", ' '}, {"\u2009", ' '}, {"\u2019", '\''}}};
  constexpr std::string_view minus = "\u2212";
  std::string plain(text);
  for (const auto& [sign, ascii] : signs)
    for (std::size_t k = plain.find(sign); k != std::string::npos; k = plain.find(sign))
      plain.replace(k, sign.size(), 1, ascii);
  if (plain.starts_with(minus)) plain.replace(0, minus.size(), 1, '-');
  return plain;
}

std::string name_of(char sign) {
  return sign == ',' ? "a comma" : sign == '.' ? "a point" : sign == ' ' ? "a blank" : "an apostrophe";
}

std::string cure(char sign) {
  return "give thousands=" + std::string("\"") + sign + "\" if it separates thousands";
}

}  // namespace

std::optional<std::string> plain_number(std::string_view text, const NumberForm& form) {
  std::string plain = with_plain_signs(text);
  if (form.thousands != '\0' && plain.find(form.thousands) != std::string::npos) {
    const std::string_view unsigned_text = without_sign(plain);
    const std::size_t end =
        std::min(unsigned_text.find_first_of(std::string("eE") + form.decimal), unsigned_text.size());
    if (!parts_thousands(unsigned_text.substr(0, end), form.thousands)) return {};
    std::erase(plain, form.thousands);
  }
  if (plain.find(form.decimal == ',' ? '.' : ',') != std::string::npos) return {};
  std::ranges::replace(plain, ',', '.');
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
  contradiction_ = {place, shown(text) + " has " + name_of(found) + " as its " +
                               (&sign == &decimal_ ? "decimal sign" : "thousands separator") +
                               ", and the others have " + name_of(sign)};
}

void NumberEvidence::add(std::string_view cell, const std::string& place) {
  std::string joined = with_plain_signs(cell);
  const std::string_view number = without_sign(joined);
  const std::string_view before = number.substr(0, std::min(number.find_first_of(".,eE"), number.size()));
  for (const char sign : {' ', '\''}) {
    if (!parts_thousands(before, sign)) continue;
    unclear_.try_emplace(sign, Doubt{place, shown(joined)});
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
    if ((comma_last ? commas : points) > 1) return;  // the reader reports it
    prove(decimal_, decimal, text, place);
    prove(thousands_, thousands, text, place);
    return;
  }
  const char sign = commas > 0 ? ',' : '.';
  const bool parts = parts_thousands(digits, sign);
  if (commas + points == 1 && (!parts || digits.front() == '0')) return prove(decimal_, sign, text, place);
  if (commas + points == 1)
    unclear_.try_emplace(sign, Doubt{place, shown(text)});
  else if (parts)
    prove(thousands_, sign, text, place);
}

NumberForm NumberEvidence::form() const {
  return {.decimal = decimal_ != '\0' ? decimal_ : thousands_ == '.' ? ',' : '.', .thousands = thousands_};
}

std::optional<NumberEvidence::Doubt> NumberEvidence::doubt() const {
  if (!contradiction_.place.empty())
    return Doubt{contradiction_.place, contradiction_.finding + "; write all numbers in one way"};
  if (decimal_ != '\0' && decimal_ == thousands_)
    return Doubt{"the numbers", name_of(decimal_) + " would be both decimal sign and thousands separator"};
  for (const auto& [sign, first] : unclear_) {
    if (sign == decimal_ || sign == thousands_) continue;
    if (sign == ' ' || sign == '\'')
      return Doubt{first.place,
                   first.finding + " has " + name_of(sign) + " between its digits; " + cure(sign)};
    if (decimal_ != '\0')
      return Doubt{first.place, first.finding + " has " + name_of(sign) + ", and the decimal sign is " +
                                    name_of(decimal_) + "; " + cure(sign)};
    if (sign == ',')
      return Doubt{
          first.place,
          first.finding +
              " may have a decimal comma or separated thousands; give decimal=\",\" or thousands=\",\""};
  }
  return {};
}

}  // namespace asperity
