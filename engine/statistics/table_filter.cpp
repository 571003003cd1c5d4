// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/table_filter.hpp"

#include <algorithm>

#include "engine/core/text.hpp"

namespace asperity {

std::vector<std::size_t> TableFilter::rows(const Table& table) const {
  std::vector<std::size_t> columns;
  for (const Condition& condition : conditions_) columns.push_back(table.column(condition.column, "where"));
  std::vector<std::size_t> matching;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    bool matches = true;
    for (std::size_t k = 0; matches && k < columns.size(); ++k) {
      const Cell& cell = table.cell(row, columns[k]);
      matches = std::ranges::any_of(conditions_[k].accepted,
                                    [&](const Cell& accepted) { return same_cell(cell, accepted); });
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
