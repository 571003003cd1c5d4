// SPDX-License-Identifier: GPL-3.0-or-later
// Columns of a table as numbers: the rows in which all columns hold a finite number, and how many rows do
// not. Empty cells, nan and infinities are left out and counted. Text is refused: what it stands for is not
// known.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "engine/statistics/table.hpp"

namespace asperity {

// The order of groups and lines: numbers first, whole or not, in ascending order, then booleans, then texts.
bool comes_before(const Cell& a, const Cell& b);

struct NumberColumns {
  std::vector<std::vector<double>> values;  // of each column, equally long
  std::vector<std::size_t> rows;            // of the table, from 0
  std::size_t left_out = 0;
};

// `named`: the key that names a column, for errors, and the column. Throws Error{unknown_name} for a column
// that is not there, Error{bad_value} naming column, row and cell for text. Cost: rows × columns.
NumberColumns number_columns(const Table& table,
                             const std::vector<std::pair<std::string, std::string>>& named);

}  // namespace asperity
