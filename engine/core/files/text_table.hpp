// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of numbers in text: any line ends, separators and decimal marks; comments; missing cells.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "engine/core/files/source_file.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"
#include "engine/core/text.hpp"

namespace asperity {

// LF, CRLF, CR CRLF (some stylus profilers) or CR.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : text_(text) {}
  // False at the end. `line` excludes the line end, not blanks.
  bool next(std::string_view& line);
  // From 1.
  std::size_t number() const { return number_; }
  std::size_t position() const { return position_; }

 private:
  std::string_view text_;
  std::size_t position_ = 0;
  std::size_t number_ = 0;
  std::size_t run_end_ = 0;  // end of the last run of CR
};

std::string_view trimmed(std::string_view text);

// Except with `comma`, a decimal comma is a point: "1,5 2,5" is two cells, "1, 5, 2" three; "1,5" alone is
// two.
enum class Separator : char { blank = ' ', tab = '\t', comma = ',', semicolon = ';' };
Separator separator_of(std::string_view line);
std::vector<std::string_view> cells_of(std::string_view line, Separator separator);

enum class CellKind { number, hole, infinite, too_large, unreadable };
struct TextCell {
  CellKind kind = CellKind::unreadable;
  double value = 0;  // NaN for a hole
};
// A hole is an empty cell, nan, bad, na, n/a, null, none, or a run of '-' or '*'.
TextCell read_cell(std::string_view text, Separator separator);

// Every cell is a number or hole, and at least one is not empty.
bool is_row_of_numbers(std::string_view line);

// Empty line or comment (# or %).
bool is_skipped(std::string_view line);

struct TextTable {
  Array<double> values;  // row by row; NaN for holes
  int columns = 0, rows = 0;
  Array<double> column(std::size_t k) const;
};
// Reads the remaining lines, without comments after #. Drops an empty last column. Throws Error{bad_file} for
// an unreadable or infinite cell or a row with another length.
TextTable read_table(LineReader& lines, const SourceFile& file, Monitor& monitor);

// Values before the first one that is off its place by more than `share` of the mean step; none unless this
// step is finite and above zero. Two values or more.
std::size_t even_values(std::span<const double> values, double share);

// True for empty text.
bool ends_with_line_end(const SourceFile& file);
// Warns of a last line without line end.
void warn_if_cut(const SourceFile& file, Monitor& monitor);

}  // namespace asperity
