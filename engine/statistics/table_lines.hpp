// SPDX-License-Identifier: GPL-3.0-or-later
// The lines of a table in a text file, taken apart into cells: UTF-8, UTF-16 or one byte a character;
// comments (#) and blank lines left out; a line of heads, or heads that were given; cells parted by
// semicolons, tabs, commas or blanks, whichever the heads are, and quoted where need be, over several lines
// too (RFC 4180). Its users interpret the cells.
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
  // Both must outlive it. Throws Error{bad_file} for bytes that are no text, and where no line is left after
  // those to skip.
  TableLines(const SourceFile& file, const TableForm& form);

  // The line of heads and what stands below it. False where there is none.
  bool read_heads();
  const std::vector<TableCell>& heads() const { return heads_; }
  const std::vector<TableCell>& below() const { return below_; }  // the next line that is no comment
  // Whether a line holds only units. An unknown unit counts if a number follows below it and if other cells
  // are known units or all cells are in brackets.
  bool units_stand_below() const;
  std::string_view head_line() const { return head_line_; }
  bool heads_are_given() const { return !form_.heads.empty(); }
  Separator separator() const { return separator_; }
  // Leaves out the line below the heads, which holds their units.
  void skip_below();

  // The next row as it stands, parted and without empty cells beyond the heads; blank lines and comments are
  // left out. False at the end. Throws Error{bad_file} where a quote is not closed, or so late that the row
  // has not as many cells as there are heads.
  bool next_row(std::vector<TableCell>& cells);
  // The next line, whatever it is; false at the end.
  bool next_line(std::string_view& line);
  // Whether nothing that follows has as many cells as there are heads: what is left stands below the table.
  // In all linear in the lines.
  bool at_end_of_table() const;
  // Whether a line that follows holds nothing but numbers, two or more. Linear in what follows.
  bool numbers_follow() const;

  // In which the last row begins.
  std::size_t line() const { return line_; }
  std::size_t position() const { return lines_.position(); }
  // Whether the last line has its line end.
  bool ends_with_a_line_end() const;
  std::string here() const { return "line " + std::to_string(line()); }
  // Cells of a line, parted by the separator.
  std::vector<TableCell> split(std::string_view line) const;
  // Without what follows a # outside quotes.
  static std::string_view without_comment(std::string_view line);
  static bool is_comment(std::string_view line);

 private:
  std::vector<TableCell> heads_between_blanks(std::string_view line, std::string_view next) const;
  // The next line and those into which its quoted cells go on; `number` is that of the first. A quote that is
  // closed nowhere ends with its line. False at the end.
  bool next_record(LineReader& lines, std::string_view& record, std::size_t& number) const;

  const SourceFile& file_;
  const TableForm& form_;
  std::optional<std::string> decoded_;
  LineReader lines_;
  std::size_t line_ = 0;
  Separator separator_ = Separator::comma;
  bool marks_known_ = false;  // that separator_ is the table's
  std::string_view head_line_;
  std::vector<TableCell> heads_, below_, second_;  // second: the line after below
  mutable std::size_t whole_row_ = 0;              // a line that is known to be one
  mutable bool ended_ = false;                     // no line that follows is one
};

// Where a character first stands outside quotes.
std::size_t find_unquoted(std::string_view line, char wanted);

}  // namespace asperity
