// SPDX-License-Identifier: GPL-3.0-or-later
// A table of free columns: each row names the columns it has, columns stand in order of first
// appearance, a cell that a row does not have is empty. A column may have a unit. Text form is CSV as
// in RFC 4180 with line feeds: numbers that read back exactly, `true`/`false`, text quoted where
// needed (empty text is `""`, an empty cell nothing), units in brackets in the header: `Ra [m]`. Whole
// numbers below 1e15 are written by their digits, without a point or an exponent. Not thread-safe; Notebook
// is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace asperity {

// Nothing, a number (SI), a boolean, text, a whole number that was given as one.
using Cell = std::variant<std::monostate, double, bool, std::string, std::int64_t>;

inline bool is_empty(const Cell& cell) { return std::holds_alternative<std::monostate>(cell); }
// Whether it holds a number, whole or not; a boolean is none.
bool is_number(const Cell& cell);
// The number in a cell, a boolean as 1 or 0; nothing for text and empty cells.
std::optional<double> number_in(const Cell& cell);
// For sentences and legends: "0.4", "true", "worn", "nothing".
std::string short_text(const Cell& cell);
// Numbers within 1e-12 of each other relative to the larger (or both nan), text and booleans exactly.
bool same_cell(const Cell& a, const Cell& b);

// One cell of a row to be written. A column named "load [N]" is column `load` with the unit N.
struct Entry {
  std::string column;
  Cell value;
  std::string unit = {};  // "" if none is known
};

struct TableColumn {
  std::string name;
  std::string unit;
};

// "load [N]" is the column load with the unit N; anything else is a name without a unit.
TableColumn split_column_unit(std::string_view name);

class Table {
 public:
  Table() = default;
  // Of these columns, which need no rows. Throws as check() does, and Error{bad_value} for a row longer than
  // the columns.
  Table(std::vector<TableColumn> columns, std::vector<std::vector<Cell>> rows);

  // What errors call it: "the notebook" unless it was given another name.
  const std::string& name() const { return name_; }
  void rename(std::string name) { name_ = std::move(name); }

  const std::vector<TableColumn>& columns() const { return columns_; }
  std::vector<std::string> column_names() const;
  std::size_t rows() const { return rows_.size(); }
  // Place of a column by its name, with or without its unit in brackets; linear in the columns.
  std::optional<std::size_t> find_column(std::string_view name) const;
  // As above. Throws Error{unknown_name} that names `key`, the column and the nearest one.
  std::size_t column(std::string_view name, std::string_view key) const;
  // Empty for a cell that was not written.
  const Cell& cell(std::size_t row, std::size_t column) const;

  // Checks an entry without changing anything. Throws Error{bad_value} for an empty row, an empty
  // column name or a column named twice, Error{bad_unit} for a unit other than the column's.
  void check(std::span<const Entry> row) const;
  // Of columns, units and cells, in their order; names of tables do not count.
  std::string digest() const;

  // Adds a row after check(); returns whether the header changed (a new column or a new unit).
  bool append(std::span<const Entry> row);
  // Adds a column, unless it is there. Throws Error{bad_value} for an empty name. Returns whether it was
  // added.
  bool declare_column(std::string_view column);
  // Gives a column, which need not exist yet, its unit. Throws Error{bad_unit} if it has another.
  // Returns whether the header changed.
  bool declare_unit(std::string_view column, std::string_view unit);

  std::string csv_header() const;
  std::string csv_row(std::size_t row) const;
  std::string csv() const;

 private:
  std::size_t place(std::string_view name);

  std::string name_ = "the notebook";
  std::vector<TableColumn> columns_;
  std::vector<std::vector<Cell>> rows_;  // a row ends with its last written cell
};

}  // namespace asperity
