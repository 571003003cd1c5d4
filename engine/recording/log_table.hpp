// SPDX-License-Identifier: GPL-3.0-or-later
// Tables that people and instruments keep of a press: a line of column titles with units, then a row a line.
// The first line that is neither blank nor a comment (#) names the columns in any order and case, with the
// unit of each quantity in [] or (). Cells are parted by commas, semicolons or tabs, whichever that line
// uses, and may be quoted; with any but commas a decimal comma is read. What the columns mean is for its
// users: press_log.hpp (a row an event) and press_recording.hpp (a row a sample). Other forms that loggers
// and spreadsheets have are not read: an error says what was met and how to write it (log_forms.hpp).
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/files/source_file.hpp"
#include "engine/core/files/text_table.hpp"
#include "engine/core/quantity.hpp"

namespace asperity {

// A column that a reader knows. Two names with one meaning may not both be given.
struct LogColumn {
  std::string_view name;
  int meaning;  // 0 … LogTable::most_meanings - 1
  Dimension dimension;
  std::string_view example;  // "time [s]"
};

struct LogCell {
  std::string text;
  bool quoted = false;
};

// One file being read. Problems are gathered, each by line and column, until fail_if_any().
class LogTable {
 public:
  static constexpr std::size_t most_meanings = 8;

  // `known` must outlive it. Throws Error{bad_file} for bytes that are no text.
  LogTable(const SourceFile& file, std::span<const LogColumn> known);

  // Reads the titles. Throws Error{bad_file} for a file without, a column without its unit or given twice.
  void read_titles();
  // The next row as it stands, its cells as many as the columns; blank lines and comments are left out, and
  // a row of another length is a problem. False at the end.
  bool next_row(std::vector<LogCell>& cells);

  std::size_t columns() const { return columns_.size(); }
  // What column k means; null for one that is left out.
  const LogColumn* column(std::size_t k) const { return columns_[k].known; }
  // The column of that meaning.
  std::optional<std::size_t> find(int meaning) const;
  bool has(int meaning) const { return find(meaning).has_value(); }
  // Titles of the columns that are left out, each with the title that may have been meant; "" if there are
  // none. Those whose title begins with "result " do not count: they are what was measured, beside what was
  // done.
  std::string others() const;

  // A number with its column's unit, in SI and exact; nothing for an empty cell, or after a problem.
  std::optional<double> quantity(std::size_t k, const LogCell& cell);
  // The factor from the column's unit to SI.
  double factor(std::size_t k) const { return columns_[k].factor; }
  // A plain number of the cell in the column's unit, or what else it holds.
  TextCell number(const LogCell& cell) const;
  // Why a cell that is no number of column k is none, and what to write: for problem().
  std::string complaint(const LogCell& cell) const;
  // To be told of each number that was read: whether the comma in it parts thousands is looked at.
  void note_comma(std::size_t k, const LogCell& cell);
  // Of columns in which every comma stands before three digits, as it does where it parts thousands.
  std::vector<std::string> comma_warnings() const;

  void problem(const std::string& place, const std::string& finding);
  std::size_t problems() const { return problem_count_; }
  // Throws Error{bad_file} with all problems, the first dozen in words.
  void fail_if_any() const;

  std::size_t line() const { return lines_.number(); }
  std::size_t position() const { return lines_.position(); }
  std::string here() const { return "line " + std::to_string(line()); }
  std::string here(std::size_t column) const;

 private:
  struct Column {
    const LogColumn* known = nullptr;
    std::string title, unit;
    double factor = 1;
    std::string thousands;  // the first number whose comma may part thousands, and its place
    bool decimals = false;  // there is one whose comma cannot
  };
  void read_title(const std::string& title, const std::vector<LogCell>& below);
  std::string lack_of_unit(const LogColumn& column, const std::vector<LogCell>& below) const;
  std::optional<std::string> meant(const Column& column) const;
  void refuse_other_forms(std::string_view line) const;

  const SourceFile& file_;
  std::span<const LogColumn> known_;
  LineReader lines_;
  Separator separator_ = Separator::comma;
  std::vector<Column> columns_;
  std::array<std::size_t, most_meanings> column_of_{};  // number from 1; 0: none
  std::vector<std::string> problems_;
  std::size_t problem_count_ = 0;
};

}  // namespace asperity
