// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/number_columns.hpp"

#include <cmath>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

bool comes_before(const Cell& a, const Cell& b) {
  const auto rank = [](const Cell& cell) {
    return is_empty(cell) ? 0 : is_number(cell) ? 1 : std::holds_alternative<bool>(cell) ? 2 : 3;
  };
  if (rank(a) != rank(b)) return rank(a) < rank(b);
  if (!is_number(a)) return a < b;
  const double x = *number_in(a), y = *number_in(b);
  if (std::isnan(x) || std::isnan(y)) return std::isnan(y) && !std::isnan(x);
  return x < y;
}

NumberColumns number_columns(const Table& table,
                             const std::vector<std::pair<std::string, std::string>>& named) {
  std::vector<std::size_t> places;
  for (const auto& [key, column] : named) places.push_back(table.column(column, key));
  NumberColumns found;
  found.values.resize(places.size());
  std::vector<double> row_values(places.size());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    bool whole = true;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Cell& cell = table.cell(row, places[k]);
      const auto number = number_in(cell);
      if (!number && !is_empty(cell))
        throw Error(ErrorCode::bad_value,
                    "column " + quoted(table.columns()[places[k]].name) + " holds the text \"" +
                        short_text(cell).substr(0, 40) + "\" in row " + std::to_string(row + 1) +
                        ", and numbers are wanted",
                    "leave such rows out with `where`, or write the numbers in a column of their own");
      whole = whole && number && std::isfinite(*number);
      row_values[k] = number.value_or(0);
    }
    if (!whole) {
      ++found.left_out;
      continue;
    }
    for (std::size_t k = 0; k < places.size(); ++k) found.values[k].push_back(row_values[k]);
    found.rows.push_back(row);
  }
  return found;
}

}  // namespace asperity
