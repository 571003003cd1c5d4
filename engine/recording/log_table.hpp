// SPDX-License-Identifier: GPL-3.0-or-later
// Tables that people and instruments keep of a press, read as any table is (statistics/table_lines.hpp): the
// first line that is neither blank nor a comment (#) names the columns in any order and case, with the unit
// of each quantity, which may also stand in the line below, in the cells, or be said beforehand; times may be
// dates and times of day. What the columns mean is for its users: press_log.hpp (a row an event) and
// press_recording.hpp (a row a sample). What others call the columns is in log_forms.cpp.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/files/source_file.hpp"
#include "engine/core/files/text_table.hpp"
#include "engine/core/monitor.hpp"
#include "engine/core/quantity.hpp"
#include "engine/statistics/file_problems.hpp"
#include "engine/statistics/stamp_column.hpp"
#include "engine/statistics/table_form.hpp"
#include "engine/statistics/table_lines.hpp"

namespace asperity {

// A column that a reader knows. Two names with one meaning may not both be given.
struct LogColumn {
  std::string_view name;
  int meaning;  // 0 … LogTable::most_meanings - 1
  Dimension dimension;
  std::string_view example;  // "time [s]"
};

using LogCell = TableCell;

// One file being read. Problems are gathered, each by line and column, until fail_if_any().
class LogTable {
 public:
  static constexpr std::size_t most_meanings = 8;

  // All must outlive it. Throws Error{bad_file} for bytes that are no text.
  LogTable(const SourceFile& file, std::span<const LogColumn> known, const TableForm& form);

  // Reads the titles. Throws Error{bad_file} for a file without, a column without its unit or given twice.
  void read_titles();
  // The next row as it stands, its cells as many as the columns; blank lines and comments are left out, and
  // a row of another length is a problem. False at the end.
  bool next_row(std::vector<LogCell>& cells);
  // All rows, and then fail_if_any().
  void read_rows(Monitor& monitor, const std::function<void(const std::vector<LogCell>&)>& read);

  std::size_t columns() const { return columns_.size(); }
  // What column k means; null for one that is left out.
  const LogColumn* column(std::size_t k) const { return columns_[k].known; }
  // The column of that meaning.
  std::optional<std::size_t> find(int meaning) const;
  bool has(int meaning) const { return find(meaning).has_value(); }
  // Titles of the ignored columns, each with the known title nearest to it; "" if there are none. Columns
  // with measured results, whose titles begin with "result ", do not count.
  std::string others() const;
  void warn_of_others(Monitor& monitor) const;
  // A problem unless one of both is given, and one alone; the meanings are those of `pressure` and `load`.
  void require_one_of(int pressure, int load);

  // A number with its column's unit, in SI and exact; nothing for an empty cell, or after a problem.
  std::optional<double> quantity(std::size_t k, const LogCell& cell);
  // The same without a problem where it holds none: a number in SI, to a rounding or two, or what else it
  // holds.
  TextCell number(std::size_t k, const LogCell& cell);
  // The error of a cell without a number of column k, and its cure: for problem().
  std::string complaint(std::size_t k, const LogCell& cell) const;
  // Ambiguous readings: columns in which three digits follow every comma, as in numbers with separated
  // thousands; days of a spreadsheet; lines below the table.
  std::vector<std::string> warnings() const;

  void problem(const std::string& place, const std::string& finding) { problems_.add(place, finding); }
  std::size_t problems() const { return problems_.count(); }
  // Throws Error{bad_file} with all problems, the first dozen in words.
  void fail_if_any() const { problems_.fail_if_any(); }

  std::size_t line() const { return lines_.line(); }
  std::size_t position() const { return lines_.position(); }
  std::string here() const { return lines_.here(); }
  std::string here(std::size_t column) const;

 private:
  struct Column {
    enum class Kind { plain, stamps, days, quantities };  // of its cells
    Kind kind = Kind::plain;
    const LogColumn* known = nullptr;
    std::string title, name, unit;  // the title without its unit in lower case
    double factor = 1;
    std::optional<StampColumn> stamps{};
    std::optional<double> first_day{};
    std::string thousands{};  // the first number whose comma may part thousands, and its place
    bool decimals = false;    // there is one whose comma cannot
  };
  void skip_preamble();
  void choose_columns();
  void refuse_unknown_names() const;
  void match_titles();
  const LogColumn* known_as(const Column& column, bool by_other_names, const std::string& below) const;
  void split_unit(Column& column) const;
  bool units_stand_below() const;
  void read_unit(std::size_t k, bool below_are_units);
  void read_without_unit(std::size_t k, const std::string& place);
  void learn_stamps(std::size_t k);
  std::optional<std::string> meant(const Column& column) const;
  void refuse_other_forms() const;
  std::size_t known_names(std::string_view titles) const;
  std::string place_of(std::size_t k) const;
  std::string text_of(const LogCell& cell) const;
  TextCell plain_cell(const LogCell& cell) const;
  std::string plain_text(const LogCell& cell) const;
  void note_comma(std::size_t k, const LogCell& cell);
  std::string below(std::size_t k) const { return k < lines_.below().size() ? lines_.below()[k].text : ""; }

  const SourceFile& file_;
  std::span<const LogColumn> known_;
  const TableForm& form_;
  TableLines lines_;
  FileProblems problems_;
  std::vector<Column> columns_;
  std::array<std::size_t, most_meanings> column_of_{};  // number from 1; 0: none
  std::vector<std::string> warnings_;
};

// --- what these tables know of titles and cells beyond what any table does (log_forms.cpp)

// A date or a time of day: "2026-11-23T10:00:00", "23.11.2026 10:00", "11/23/2026 10:00 AM", "10:00:03.2".
bool is_time_stamp(std::string_view cell);

// A day of this century counted from 1900, as spreadsheets keep dates: 36526 to 73415.
bool is_day_of_a_spreadsheet(const TextCell& cell);

// A title taken apart, however its unit stands in it: "Kraft / kN", "time_s", "Force (N)", "load kN".
struct LogTitle {
  std::string name;  // lower case, the first word
  std::string unit;  // "" where there is none
};
LogTitle log_title(std::string_view title);

// Cells of a line at its semicolons, else its tabs, else its commas, as they stand and without their quotes.
std::vector<std::string> log_cells(std::string_view line);

// The heads of a table below other lines.
struct FoundHeads {
  std::size_t line;  // of the file, from 1
  std::string text;
};
// The first line of words above a table, among 300 lines; else nothing. A line of units may follow. The table
// has three rows, or fewer at the end of the file; each row has as many cells as the line of words, and its
// first cell and another are numbers or times.
std::optional<FoundHeads> find_heads(TableLines lines);

// Whether a word may mean the column: its own name, or what others call it ("kraft" for load, "angle" for
// rotation).
bool means(std::string_view word, std::string_view column);
// Whether it can mean nothing else: an angle may be that of the stage or a turn by so much.
bool surely_means(std::string_view word, std::string_view column);

// What a time that runs backwards by so many seconds asks for where it may be a time of day: its date.
std::string past_midnight(double seconds_back);

// The sign that may separate thousands ("1.234,5", "1'234", "1 234") and alone keeps the text from being a
// number: a key `thousands` takes the sign. "" if there is no such sign.
std::string_view thousands_in(std::string_view text);

}  // namespace asperity
