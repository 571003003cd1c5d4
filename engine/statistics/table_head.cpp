// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/table_head.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/files/text_table.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

bool is_unit(std::string_view text) {
  const std::optional<Quantity> unit = known_unit(text);
  return unit && (unit->dimension != dimension::number || text == "%");
}

// Units that are also words: minimum, in, turn, Run N, group t.
bool may_be_a_word(std::string_view text) {
  static constexpr std::array<std::string_view, 11> words{"min", "in",   "bar", "turn", "rev", "mil",
                                                          "ft",  "inch", "us",  "pm",   "lb"};
  if (text == "%") return false;
  return text.size() < 2 || std::ranges::find(words, text) != words.end() ||
         text.find_first_not_of("0123456789") == std::string_view::npos;
}

// "Force (kN, filtered)": the remark stays in the name.
std::optional<TableHead> with_remark(std::string_view name, std::string_view inside) {
  const std::size_t comma = inside.find(',');
  if (comma == std::string_view::npos) return {};
  const std::string_view unit = trimmed(inside.substr(0, comma)), remark = trimmed(inside.substr(comma + 1));
  if (!is_unit(unit) || remark.empty() || (unit.size() > 1 && may_be_a_word(unit))) return {};
  return TableHead{std::string(trimmed(name)) + " (" + std::string(remark) + ")", std::string(unit)};
}

}  // namespace

std::optional<Quantity> known_unit(std::string_view text) {
  try {
    return parse_unit(text);
  } catch (const Error&) {  // no unit
    return {};
  }
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
  if (unit.empty() || std::isdigit(static_cast<unsigned char>(unit[0])) != 0) return {};
  return known_unit(unit);
}

std::optional<Quantity> quantity_in_cell(std::string_view cell) {
  std::string text(trimmed(cell));
  const std::size_t digit = text.find_first_of("0123456789");
  if (digit == std::string::npos || digit > 2) return {};
  if (const std::size_t comma = text.find(','); comma != std::string::npos) text[comma] = '.';
  try {
    const Quantity quantity = parse_quantity(text);
    if (quantity.dimension != dimension::number || text.ends_with('%')) return quantity;
  } catch (const Error&) {  // something else
  }
  return {};
}

TableHead table_head(std::string_view title) {
  title = trimmed(title);
  const TableHead whole{std::string(title), {}};
  const auto head = [](std::string_view name, std::string_view unit) {
    return TableHead{std::string(trimmed(name)), std::string(trimmed(unit))};
  };
  for (const std::string_view brackets : {"[]", "()"}) {
    const std::size_t open = title.rfind(brackets[0]);
    if (!title.ends_with(brackets[1]) || open == std::string_view::npos || open == 0) continue;
    const std::string_view name = title.substr(0, open);
    const std::string_view inside = trimmed(title.substr(open + 1, title.size() - open - 2));
    if (const auto remark = with_remark(name, inside)) return *remark;
    const bool unit = brackets[0] == '[' || is_unit(inside) || inside == "-" || inside == "1";
    return unit ? head(name, inside) : whole;
  }
  for (const auto& [at, width] : {std::pair{title.find(" / "), 3}, std::pair{title.rfind(','), 1}})
    if (at != std::string_view::npos && at > 0 && is_unit(trimmed(title.substr(at + width))))
      return head(title.substr(0, at), title.substr(at + width));
  if (const std::size_t blank = title.rfind(' '); blank != std::string_view::npos) {
    const std::string_view last = title.substr(blank + 1);
    if (!may_be_a_word(last) && is_unit(last)) return head(title.substr(0, blank), last);
  }
  return whole;
}

HeadMatch find_head(const std::vector<HeadedColumn>& columns, std::string_view head, bool any_case) {
  const auto plain = [any_case](std::string_view text) {
    return any_case ? lower_case(text) : std::string(text);
  };
  const std::string wanted = plain(trimmed(head));
  for (const auto part : {&HeadedColumn::title, &HeadedColumn::name}) {
    HeadMatch match;
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (plain(columns[k].*part) == wanted && match.count++ == 0) match.first = k;
    if (match.count > 0) return match;
  }
  return {};
}

std::vector<std::string> head_names(const std::vector<HeadedColumn>& columns) {
  std::vector<std::string> names;
  for (const HeadedColumn& column : columns) {
    names.push_back(plain_text(column.title));
    if (column.name != column.title) names.push_back(plain_text(column.name));
  }
  return names;
}

std::string head_complaint(const std::vector<HeadedColumn>& columns, const HeadMatch& match,
                           std::string_view head, const std::string& called) {
  return (match.count == 0 ? std::string("no column is") : std::to_string(match.count) + " columns are") +
         " headed \"" + plain_text(std::string(head)) + "\", which `columns` calls " + quoted(called) +
         (match.count == 0 ? did_you_mean(head, head_names(columns)) : "; give the head with its unit");
}

}  // namespace asperity
