// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/table_filter.hpp"

#include <algorithm>

#include "engine/core/error.hpp"
#include "engine/core/files/text_table.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

// In the unit of the condition's name, or a quantity.
Cell wanted_in_si(const Cell& accepted, const std::string& unit_in_name, const TableColumn& column) {
  const auto* text = std::get_if<std::string>(&accepted);
  if (text == nullptr) return cell_in_si(accepted, unit_in_name);
  if (column.unit.empty()) return accepted;
  if (trimmed(*text).find_first_of("0123456789") != trimmed(*text).find_first_not_of("+-.")) return accepted;
  try {
    return from_unit(parse_quantity_in(*text, column.unit), column.unit);
  } catch (const Error& error) {
    throw Error(ErrorCode::bad_unit, "`where." + column.name + "`: " + error.sentence(), error.hint());
  }
}

}  // namespace

std::vector<std::size_t> TableFilter::rows(const Table& table) const {
  std::vector<std::size_t> columns;
  std::vector<std::vector<Cell>> wanted;
  for (const Condition& condition : conditions_) {
    columns.push_back(table.column(condition.column, "where"));
    wanted.emplace_back();
    for (const Cell& accepted : condition.accepted)
      wanted.back().push_back(
          wanted_in_si(accepted, split_column_unit(condition.column).unit, table.columns()[columns.back()]));
  }
  std::vector<std::size_t> matching;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    bool matches = true;
    for (std::size_t k = 0; matches && k < columns.size(); ++k) {
      const Cell& cell = table.cell(row, columns[k]);
      matches =
          std::ranges::any_of(wanted[k], [&](const Cell& accepted) { return same_cell(cell, accepted); });
    }
    if (matches) matching.push_back(row);
  }
  return matching;
}

std::string TableFilter::text() const {
  std::string text;
  for (const Condition& condition : conditions_) {
    std::vector<std::string> values;
    for (const Cell& cell : condition.accepted) values.push_back(short_text(cell));
    if (!text.empty()) text += " and ";
    text += quoted(condition.column) + " = " + joined(values);
  }
  return text;
}

}  // namespace asperity
