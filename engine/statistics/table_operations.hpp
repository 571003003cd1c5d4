// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/statistics/table.hpp"

namespace asperity {

Table rows_of(const Table& table, std::span<const std::size_t> rows);

// "2.8 um"; other cells as short_text().
std::string text_with_unit(const Cell& cell, const std::string& unit);

// Numbers in display units, each rounded once; a unit in one of `named` replaces the column's. For charts and
// messages: other table functions expect SI.
Table in_display_units(const Table& table, std::span<const std::string> named = {});

// For rows without partner.
enum class Unmatched { refuse, leave_out, keep };

struct Join {
  std::vector<std::string> by;
  std::string suffix{};  // for common names; "" refuses them
  Unmatched unmatched = Unmatched::refuse;
};

// Joins each row of `table` with each row of `other` equal in the columns `by` (same_cell, in one unit).
// Ignores rows of `other` without partner. Throws Error{unknown_name} for a missing column, Error{bad_unit}
// for different kinds of units, Error{bad_value} for a common name without suffix, for refused rows without
// partner, and if repeated rows meet repeated rows. O(n log n).
Table joined(const Table& table, const Table& other, const Join& join);

// All for an empty list; a unit in a name becomes the display unit. Throws as Table::column.
Table columns_of(const Table& table, std::span<const std::string> names);

// At most `most` rows, in display units; counts the others.
std::string table_text(const Table& table, std::size_t most = 20, int digits = 6);

}  // namespace asperity
