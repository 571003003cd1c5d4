// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of a table in a text file, split into cells: UTF-8, UTF-16 or one byte per character, without
// comments (#) and blank lines. Semicolons, tabs, commas or blanks separate cells, as in the heads. Quoted
// cells may span lines (RFC 4180).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/files/source_file.hpp"
#include "engine/core/files/text_table.hpp"
#include "engine/statistics/table_form.hpp"

namespace asperity {

struct TableCell {
  std::string text;
  bool quoted = false;
};

class TableLines {
 public:
  // Arguments must outlive the object. Throws Error{bad_file} for bytes other than text and for fewer than
  // `skip` lines.
  TableLines(const SourceFile& file, const TableForm& form);

  // False without heads.
  bool read_heads();
  const std::vector<TableCell>& heads() const { return heads_; }
  const std::vector<TableCell>& below() const { return below_; }  // next line without comment
  // An unknown unit counts if a number is below it and other cells are known units or all cells are in
  // brackets.
  bool units_stand_below() const;
  std::string_view head_line() const { return head_line_; }
  bool heads_are_given() const { return !form_.heads.empty(); }
  Separator separator() const { return separator_; }
  void skip_below();

  // Without empty cells beyond the heads. False at the end. Throws Error{bad_file} for a quote that is never
  // closed, or closed in a row of the wrong length.
  bool next_row(std::vector<TableCell>& cells);
  // False at the end.
  bool next_line(std::string_view& line);
  // Whether the rest is below the table: no later line has a cell for each head. O(lines) in total.
  bool at_end_of_table() const;
  // Whether a later line contains only numbers, at least two. O(remaining lines).
  bool numbers_follow() const;

  std::size_t line() const { return line_; }
  std::size_t position() const { return lines_.position(); }
  bool ends_with_a_line_end() const;
  std::string here() const { return "line " + std::to_string(line()); }
  std::vector<TableCell> split(std::string_view line) const;
  // Cut at a # outside quotes.
  static std::string_view without_comment(std::string_view line);
  static bool is_comment(std::string_view line);

 private:
  std::vector<TableCell> heads_between_blanks(std::string_view line, std::string_view next) const;
  Separator separator_by(std::string_view heads, std::string_view next, std::string_view second) const;
  // Joins lines within quotes; `number`: first line. A quote never closed ends with its line. False at the
  // end.
  bool next_record(LineReader& lines, std::string_view& record, std::size_t& number) const;

  const SourceFile& file_;
  const TableForm& form_;
  std::optional<std::string> decoded_;
  LineReader lines_;
  std::size_t line_ = 0;
  Separator separator_ = Separator::comma;
  bool marks_known_ = false;  // separator_ is final
  std::string_view head_line_;
  std::vector<TableCell> heads_, below_, second_;  // `second_`: line after below
  mutable std::size_t whole_row_ = 0;              // a later full row
  mutable bool ended_ = false;                     // no later full row
};

std::size_t find_unquoted(std::string_view line, char wanted);

}  // namespace asperity
