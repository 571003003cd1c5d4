// SPDX-License-Identifier: GPL-3.0-or-later
// Tables made of tables: some of the rows, and the rows of one beside those of another that they belong to,
// as measured numbers stand beside computed ones.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/statistics/table.hpp"

namespace asperity {

// These rows, in this order, under all columns; the name stays.
Table rows_of(const Table& table, std::span<const std::size_t> rows);

// The numbers of columns with a unit in SI, each rounded once: 0.1 um is the double nearest to 1e-7 m. Whole
// numbers of such columns become numbers. Throws Error{bad_unit} for a unit that cannot be read.
Table in_si(const Table& table);

// Treatment of rows without a partner.
enum class Unmatched { refuse, leave_out, keep };

struct Join {
  std::vector<std::string> by;  // columns of both; one at least
  std::string suffix{};         // behind the names of the other's columns that both have; "" refuses them
  Unmatched unmatched = Unmatched::refuse;
};

// For each row of `table`, in order, each row of `other` that has the same cells (same_cell, numbers counted
// in one unit) in the columns `by`, side by side: the columns of `table`, then the other's less those. With
// Unmatched::keep a row of `table` without a partner stands alone. Throws Error{unknown_name} for a column
// that is not in both, Error{bad_unit} where units of `by` are of different kinds, Error{bad_value} for a
// name that both have without a suffix, for rows of `table` without a partner if these are refused, and where
// equal rows of one meet equal rows of the other. Rows of `other` that belong to none are left out. O(n log
// n).
Table joined(const Table& table, const Table& other, const Join& join);

// The table as text: a line of heads, then rows, numbers in the units that make them readable. Of more than
// `most` rows the last ones are counted only.
std::string table_text(const Table& table, std::size_t most = 20);

}  // namespace asperity
