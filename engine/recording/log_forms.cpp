// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/recording/log_forms.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "engine/core/error.hpp"

namespace asperity {

namespace {

bool is_digit_at(std::string_view text, std::size_t k) {
  return k < text.size() && std::isdigit(static_cast<unsigned char>(text[k])) != 0;
}

std::optional<Quantity> quantity_if_any(std::string_view text, Quantity (*parse)(std::string_view)) {
  try {
    return parse(text);
  } catch (const Error&) {  // something else
    return {};
  }
}

// Words of other tables for the columns of log_table.hpp.
constexpr std::array<std::pair<std::string_view, std::string_view>, 14> other_names{{{"force", "load"},
                                                                                     {"kraft", "load"},
                                                                                     {"last", "load"},
                                                                                     {"charge", "load"},
                                                                                     {"druck", "pressure"},
                                                                                     {"stress", "pressure"},
                                                                                     {"spannung", "pressure"},
                                                                                     {"zeit", "time"},
                                                                                     {"temps", "time"},
                                                                                     {"angle", "rotation"},
                                                                                     {"winkel", "angle"},
                                                                                     {"winkel", "rotation"},
                                                                                     {"hold", "dwell"},
                                                                                     {"haltezeit", "dwell"}}};

}  // namespace

// Two digits or more on both sides of a colon, or three groups of digits with one mark between them.
bool is_time_stamp(std::string_view cell) {
  for (std::size_t k = 1; k < cell.size(); ++k)
    if (cell[k] == ':' && is_digit_at(cell, k - 1) && is_digit_at(cell, k + 1) && is_digit_at(cell, k + 2))
      return true;
  std::size_t k = 0;
  while (is_digit_at(cell, k)) ++k;
  if (k < 1 || k > 4 || k >= cell.size()) return false;
  const char mark = cell[k];
  if (mark != '-' && mark != '/' && mark != '.') return false;
  const std::size_t middle = k + 1;
  std::size_t end = middle;
  while (is_digit_at(cell, end)) ++end;
  return end > middle && end <= middle + 2 && end < cell.size() && cell[end] == mark &&
         is_digit_at(cell, end + 1);
}

bool is_day_of_a_spreadsheet(const TextCell& cell) {
  constexpr double first = 36526, last = 73415;
  return cell.kind == CellKind::number && cell.value >= first && cell.value <= last;
}

std::string bare_unit(std::string_view cell) {
  cell = trimmed(cell);
  if (cell.size() >= 2 && (cell.front() == '[' || cell.front() == '(') &&
      (cell.back() == ']' || cell.back() == ')'))
    cell = trimmed(cell.substr(1, cell.size() - 2));
  return std::string(cell);
}

std::optional<Quantity> unit_in_cell(std::string_view cell) {
  const std::string unit = bare_unit(cell);
  if (unit.empty() || is_digit_at(unit, 0)) return {};
  return quantity_if_any(unit, parse_unit);
}

bool has_unit(std::string_view cell) {
  const std::optional<Quantity> quantity = quantity_if_any(cell, parse_quantity);
  return quantity && quantity->dimension != dimension::number;
}

LogTitle log_title(std::string_view title) {
  title = trimmed(title);
  LogTitle parts;
  const std::size_t end = std::min(title.find_first_of(" _/[(:,\t"), title.size());
  parts.name = lower_case(title.substr(0, end));
  std::string_view rest = title.substr(end);
  while (!rest.empty() && std::string_view(" _/:,\t").find(rest.front()) != std::string_view::npos)
    rest.remove_prefix(1);
  // "force applied [kN]"
  if (const std::size_t open = rest.find_last_of("[("); open != std::string_view::npos)
    rest = rest.substr(open);
  parts.unit = bare_unit(rest);
  return parts;
}

bool means(std::string_view word, std::string_view column) {
  return word == column || std::any_of(other_names.begin(), other_names.end(), [&](const auto& pair) {
           return pair.first == word && pair.second == column;
         });
}

}  // namespace asperity
