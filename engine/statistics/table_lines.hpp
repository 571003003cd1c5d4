// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of a table in a text file, split into cells: UTF-8, UTF-16 or one byte per character, without
// comments (#) and blank lines. Semicolons, tabs, commas or blanks separate cells, as in the heads. Quoted
// cells may span lines (RFC 4180).
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/files/source_file.hpp"
#include "engine/core/files/text_table.hpp"
#include "engine/core/monitor.hpp"
#include "engine/statistics/table_form.hpp"

namespace asperity {

struct TableCell {
  std::string text;
  bool quoted = false;
};

class FileProblems {
 public:
  explicit FileProblems(const SourceFile& file) : file_(file) {}
  // "line 3, column 2 (load)": "\"x\" is no number".
  void add(const std::string& place, const std::string& finding);
  std::size_t count() const { return count_; }
  // Throws Error{bad_file} with the first dozen problems.
  void fail_if_any() const;

 private:
  const SourceFile& file_;
  std::vector<std::string> sentences_;
  std::size_t count_ = 0;
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
  // An unknown unit needs a number below, and known units or brackets in all other cells.
  bool units_stand_below() const;
  std::string_view head_line() const { return head_line_; }
  bool heads_are_given() const { return !form_.heads.empty(); }
  Separator separator() const { return separator_; }
  void skip_below();

  // Without empty cells beyond the heads. False at the end. Throws Error{bad_file} for a quote never closed,
  // or closed in a row of the wrong length.
  bool next_row(std::vector<TableCell>& cells);
  // Passes rows with at least as many cells as heads, until `take` returns false. Others are problems; words
  // below the table give a warning.
  void read_rows(Monitor& monitor, FileProblems& problems,
                 const std::function<bool(std::vector<TableCell>&)>& take);
  // False at the end.
  bool next_line(std::string_view& line);

  std::size_t line() const { return line_; }
  std::string here() const { return "line " + std::to_string(line()); }
  // Cut at a # outside quotes.
  static std::string_view without_comment(std::string_view line);
  static bool is_comment(std::string_view line);

 private:
  // No later line has a cell for each head. O(lines) in total.
  bool at_end_of_table() const;
  // A later line has only numbers, at least two. O(remaining lines).
  bool numbers_follow() const;
  Separator separator_by(std::string_view heads, std::string_view next, std::string_view second) const;
  // Skips comments and joins lines within quotes, or ends at the line of an open quote; `number`: first line.
  // False at the end.
  bool next_record(LineReader& lines, std::string_view& record, std::size_t& number) const;

  const SourceFile& file_;
  const TableForm& form_;
  LineReader lines_;
  std::size_t line_ = 0;
  Separator separator_ = Separator::comma;
  bool marks_known_ = false;  // separator_ is final
  std::string_view head_line_;
  std::vector<TableCell> heads_, below_, second_;  // `second_`: line after below
  mutable std::size_t whole_row_ = 0;              // a later full row
  mutable bool ended_ = false;                     // no later full row
};

// Semicolons, else tabs, else commas, outside quotes; else nothing.
std::optional<Separator> marks_in(std::string_view line);
// Without quotes.
std::vector<TableCell> split_cells(std::string_view line, Separator separator);
// At semicolons, else tabs, commas or blanks; units in brackets or after a slash stay with their names.
std::vector<TableCell> head_cells(std::string_view line);

}  // namespace asperity
