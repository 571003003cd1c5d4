// SPDX-License-Identifier: GPL-3.0-or-later
// Table with free columns in order of first appearance; missing cells are empty. Numbers are in SI; a
// column's unit serves display only: files, charts, messages. CSV as in RFC 4180 with line feeds: numbers in
// display units that read back exactly, empty text is `""`, units in brackets in the header, `Ra [um]`. Whole
// numbers below 1e15 have no point or exponent. Not thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/core/quantity.hpp"

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
// Numbers within a relative 1e-12 (nan equals nan), others exactly.
bool same_cell(const Cell& a, const Cell& b);
// Order of sorted rows: empty cells, ascending numbers, nan, booleans, texts.
bool comes_before(const Cell& a, const Cell& b);

// In kN under "load [kN]". Under a plain name a number is in SI, and `unit` is its display unit.
struct Entry {
  std::string column;
  Cell value;
  std::string unit = {};
};

struct TableColumn {
  std::string name;
  std::string unit;          // for display
  std::string mean_of = {};  // the averaged column
  bool plain = false;        // numbers without a unit, not numbers in SI
};

// "load [N]", "load[N]", "load (N)" and "load / N" give `load` and N. Unknown units stay in the name.
TableColumn split_column_unit(std::string_view name);
// A script's number: in the unit of the column's name, or in SI.
Cell cell_in_si(const Cell& cell, const std::string& unit_in_name);

class Table {
 public:
  Table() = default;
  // Throws as resolved(), and Error{bad_value} for a row longer than the columns.
  Table(std::vector<TableColumn> columns, std::vector<std::vector<Cell>> rows,
        std::string name = "the notebook");

  // In errors; "the notebook" by default.
  const std::string& name() const { return name_; }
  void rename(std::string name) { name_ = std::move(name); }

  const std::vector<TableColumn>& columns() const { return columns_; }
  std::vector<std::string> column_names() const;
  std::size_t rows() const { return rows_.size(); }
  // Ignores a unit in `name`. O(columns).
  std::optional<std::size_t> find_column(std::string_view name) const;
  // Throws Error{unknown_name} with `key`, column and nearest name, and Error{bad_unit} for a unit of another
  // dimension in `name`.
  std::size_t column(std::string_view name, std::string_view key) const;
  // The unit in `name`, or the column's. Throws Error{bad_unit} for another dimension.
  std::string display_unit_of(std::string_view name, std::size_t column) const;
  const Cell& cell(std::size_t row, std::size_t column) const;

  // Names without units, numbers in SI, display units of the columns. Throws Error{bad_value} for an empty
  // row, an empty or repeated column name, Error{bad_unit} for another dimension.
  std::vector<Entry> resolved(std::span<const Entry> row) const;
  // Ignores the table's name and display units.
  std::string digest() const;

  // True for a new header. Throws as resolved().
  bool append(std::span<const Entry> row);
  // True for a new column. Throws Error{bad_value} for an empty name.
  bool declare_column(std::string_view column);
  void declare_dimension(std::string_view column, Dimension dimension);
  // Sets the display unit; adds a missing column. True for a new header. Throws Error{bad_unit} for another
  // dimension.
  bool declare_unit(std::string_view column, std::string_view unit);

  std::string csv_header() const;
  std::string csv_row(std::size_t row) const;
  std::string csv() const;

 private:
  std::size_t place(std::string_view name);

  std::string name_ = "the notebook";
  std::vector<TableColumn> columns_;
  std::vector<std::vector<Cell>> rows_;  // up to the last written cell
};

}  // namespace asperity
