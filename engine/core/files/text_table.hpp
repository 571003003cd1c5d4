// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of numbers as people and instruments write them: lines ended in any way, cells parted by
// blanks, tabs, commas or semicolons, decimal points or commas, comments, missing cells. Used by
// every text format. Makes no sense of what the columns mean.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/files/source_file.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// Lines ended by LF, CRLF, CR CRLF (as some stylus profilers write) or CR alone.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : text_(text) {}
  // False at the end. `line` has no line end; blanks are kept.
  bool next(std::string_view& line);
  // Number of the line that next() gave last, from 1.
  std::size_t number() const { return number_; }
  // Bytes consumed.
  std::size_t position() const { return position_; }

 private:
  std::string_view text_;
  std::size_t position_ = 0;
  std::size_t number_ = 0;
  std::size_t run_end_ = 0;  // of the last run of CR
};

std::string_view trimmed(std::string_view text);
std::string lower_case(std::string_view text);
// At most 24 bytes of a line, whole characters of UTF-8, unprintable ones shown as '?', for errors.
std::string shown(std::string_view text);

// How the cells of a line are parted. With any separator but the comma a decimal comma is read as a
// point. "1,5 2,5" is two cells with decimal commas, "1, 5, 2" three; "1,5" alone is two cells.
enum class Separator { blank, tab, comma, semicolon };
Separator separator_of(std::string_view line);
std::vector<std::string_view> cells_of(std::string_view line, Separator separator);

enum class CellKind { number, hole, infinite, too_large, unreadable };
struct TextCell {
  CellKind kind = CellKind::unreadable;
  double value = 0;  // NaN for a hole
};
// A hole is an empty cell, nan, bad, na, n/a, null, none, or a run of '-' or '*'.
TextCell read_cell(std::string_view text, Separator separator);

// True if every cell of the line is a number or a hole and one at least is not empty.
bool is_row_of_numbers(std::string_view line);

// True for a line that a table skips: empty, or a comment (# or %).
bool is_skipped(std::string_view line);

struct TextTable {
  Array<double> values;  // row by row; NaN for holes
  int columns = 0, rows = 0;
};
// Reads the rest of the lines. Text after # is a comment. A last column that is empty in every line
// is dropped (a separator at the end of each line). Throws Error{bad_file} naming the line for a
// cell that is no number, an infinite one, or a row of another length.
TextTable read_table(LineReader& lines, const SourceFile& file, Monitor& monitor);

// Warns where the last line of a text has no end: a file that was cut within its last number looks the same.
void warn_if_cut(const SourceFile& file, Monitor& monitor);

}  // namespace asperity
