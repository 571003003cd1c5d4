// SPDX-License-Identifier: GPL-3.0-or-later
// Table with free columns in order of first appearance; missing cells are empty. CSV as in RFC 4180 with line
// feeds: numbers read back exactly, empty text is `""`, units are in brackets in the header, `Ra [m]`. Whole
// numbers below 1e15 have no point or exponent. Not thread-safe; Notebook is.
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

// Empty, number in SI, boolean, text, whole number.
using Cell = std::variant<std::monostate, double, bool, std::string, std::int64_t>;

inline bool is_empty(const Cell& cell) { return std::holds_alternative<std::monostate>(cell); }
// False for booleans.
bool is_number(const Cell& cell);
// A boolean is 1 or 0; nothing for text and empty cells.
std::optional<double> number_in(const Cell& cell);
// For messages: "0.4", "true", "worn", "nothing".
std::string short_text(const Cell& cell);
// Numbers within a relative 1e-12 (or both nan), others exactly.
bool same_cell(const Cell& a, const Cell& b);

// Column "load [N]" is `load` with the unit N.
struct Entry {
  std::string column;
  Cell value;
  std::string unit = {};
};

struct TableColumn {
  std::string name;
  std::string unit;
};

// "load [N]" gives `load` and N.
TableColumn split_column_unit(std::string_view name);

class Table {
 public:
  Table() = default;
  // Throws as check(), and Error{bad_value} for a row longer than the columns.
  Table(std::vector<TableColumn> columns, std::vector<std::vector<Cell>> rows);

  // In errors; "the notebook" by default.
  const std::string& name() const { return name_; }
  void rename(std::string name) { name_ = std::move(name); }

  const std::vector<TableColumn>& columns() const { return columns_; }
  std::vector<std::string> column_names() const;
  std::size_t rows() const { return rows_.size(); }
  // By name, with or without unit; O(columns).
  std::optional<std::size_t> find_column(std::string_view name) const;
  // Throws Error{unknown_name} with `key`, the column and the nearest name.
  std::size_t column(std::string_view name, std::string_view key) const;
  const Cell& cell(std::size_t row, std::size_t column) const;

  // Throws Error{bad_value} for an empty row, an empty or repeated column name, Error{bad_unit} for a
  // different unit.
  void check(std::span<const Entry> row) const;
  // Ignores the table name.
  std::string digest() const;

  // Returns whether the header changed. Throws as check().
  bool append(std::span<const Entry> row);
  // Returns whether the column is new. Throws Error{bad_value} for an empty name.
  bool declare_column(std::string_view column);
  // Adds a missing column. Throws Error{bad_unit} for a different unit. Returns whether the header changed.
  bool declare_unit(std::string_view column, std::string_view unit);

  std::string csv_header() const;
  std::string csv_row(std::size_t row) const;
  std::string csv() const;

 private:
  std::size_t place(std::string_view name);

  std::string name_ = "the notebook";
  std::vector<TableColumn> columns_;
  std::vector<std::vector<Cell>> rows_;  // end with the last written cell
};

}  // namespace asperity
