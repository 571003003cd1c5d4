// SPDX-License-Identifier: GPL-3.0-or-later
// Selecting and joining table rows, for example measured with computed numbers.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/statistics/table.hpp"

namespace asperity {

Table rows_of(const Table& table, std::span<const std::size_t> rows);

// Converts columns with units to SI, each number rounded once. Whole numbers become doubles. Throws
// Error{bad_unit} for an unreadable unit.
Table in_si(const Table& table);

// For rows without partner.
enum class Unmatched { refuse, leave_out, keep };

struct Join {
  std::vector<std::string> by;
  std::string suffix{};  // for names in both tables; "" refuses them
  Unmatched unmatched = Unmatched::refuse;
};

// Joins each row of `table` with each row of `other` equal in the columns `by` (same_cell, in one unit).
// Ignores rows of `other` without partner. Throws Error{unknown_name} for a column missing in either table,
// Error{bad_unit} for different kinds of units, Error{bad_value} for a common name without suffix, for
// refused rows without partner, and if repeated rows meet repeated rows. O(n log n).
Table joined(const Table& table, const Table& other, const Join& join);

// At most `most` rows in readable units, and the number of others.
std::string table_text(const Table& table, std::size_t most = 20);

}  // namespace asperity
