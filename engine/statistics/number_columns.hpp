// SPDX-License-Identifier: GPL-3.0-or-later
// The table rows with finite numbers in all requested columns.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "engine/statistics/table.hpp"

namespace asperity {

// Ascending numbers, booleans, texts.
bool comes_before(const Cell& a, const Cell& b);

struct NumberColumns {
  std::vector<std::vector<double>> values;  // by column, equally long
  std::vector<std::size_t> rows;            // from 0
  std::size_t left_out = 0;
};

// `named`: key (for errors) and column. Throws Error{unknown_name} for a missing column, Error{bad_value}
// naming column, row and cell for text. O(rows × columns).
NumberColumns number_columns(const Table& table,
                             const std::vector<std::pair<std::string, std::string>>& named);

}  // namespace asperity
