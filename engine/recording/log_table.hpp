// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of a press by people or instruments (statistics/table_lines.hpp). The first line that is neither
// blank nor a comment (#) names the columns in any order and case. Units are in titles, in the next line, in
// cells, or given. Times may be dates and times of day.
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

// Two names with one meaning exclude each other.
struct LogColumn {
  std::string_view name;
  int meaning;  // 0 … LogTable::most_meanings - 1
  Dimension dimension;
  std::string_view example;  // "time [s]"
};

using LogCell = TableCell;

// Collects problems until fail_if_any().
class LogTable {
 public:
  static constexpr std::size_t most_meanings = 8;

  // Arguments must outlive the table. Throws Error{bad_file} unless the bytes are text.
  LogTable(const SourceFile& file, std::span<const LogColumn> known, const TableForm& form);

  // Throws Error{bad_file} if titles or a unit are missing, or a column appears twice.
  void read_titles();
  // Skips blank lines and comments; another length is a problem. False at the end.
  bool next_row(std::vector<LogCell>& cells);
  void read_rows(Monitor& monitor, const std::function<void(const std::vector<LogCell>&)>& read);

  std::size_t columns() const { return columns_.size(); }
  // Null for an ignored column.
  const LogColumn* column(std::size_t k) const { return columns_[k].known; }
  std::optional<std::size_t> find(int meaning) const;
  bool has(int meaning) const { return find(meaning).has_value(); }
  // Ignored columns with the nearest known title, except "result …".
  std::string others() const;
  void warn_of_others(Monitor& monitor) const;
  // A problem unless exactly one is given.
  void require_one_of(int pressure, int load);

  // Exact, in SI; none for an empty cell or after a problem.
  std::optional<double> quantity(std::size_t k, const LogCell& cell);
  // The same without problems, in SI up to rounding; may be no number.
  TextCell number(std::size_t k, const LogCell& cell);
  // Error and cure for problem().
  std::string complaint(std::size_t k, const LogCell& cell) const;
  // Ambiguity: three digits after every comma of a column, days of a spreadsheet, lines below the table.
  std::vector<std::string> warnings() const;

  void problem(const std::string& place, const std::string& finding) { problems_.add(place, finding); }
  std::size_t problems() const { return problems_.count(); }
  // With the first dozen problems in words.
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
    std::string title, name, unit;  // lower-case title without unit
    double factor = 1;
    std::optional<StampColumn> stamps{};
    std::optional<double> first_day{};
    std::string thousands{};  // first comma that may separate thousands, and its place
    bool decimals = false;    // some comma is decimal
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
  std::array<std::size_t, most_meanings> column_of_{};  // from 1; 0: none
  std::vector<std::string> warnings_;
};

// --- titles and cells (log_forms.cpp)

// A date or a time of day: "2026-11-23T10:00:00", "23.11.2026 10:00", "11/23/2026 10:00 AM", "10:00:03.2".
bool is_time_stamp(std::string_view cell);

// Since 1900, as in spreadsheets: 36526 to 73415.
bool is_day_of_a_spreadsheet(const TextCell& cell);

// "Kraft / kN", "time_s", "Force (N)", "load kN".
struct LogTitle {
  std::string name;  // first word in lower case
  std::string unit;  // "" where there is none
};
LogTitle log_title(std::string_view title);

// Splits at semicolons, else tabs, else commas; removes quotes.
std::vector<std::string> log_cells(std::string_view line);

struct FoundHeads {
  std::size_t line;  // from 1
  std::string text;
};
// The first line of words above a table, among 300 lines; a line of units may follow. The table has three
// rows, or fewer at the end of the file, of as many cells, with numbers or times in the first cell and
// another.
std::optional<FoundHeads> find_heads(TableLines lines);

// By its own or a foreign name: "kraft" for load, "angle" for rotation.
bool means(std::string_view word, std::string_view column);
// False for ambiguous words: an angle may be the stage's or a rotation.
bool surely_means(std::string_view word, std::string_view column);

// A hint if a time of day may lack its date.
std::string past_midnight(double seconds_back);

// The thousands separator that alone keeps the text from being a number ("1.234,5", "1'234", "1 234"), for
// the key `thousands`; "" if none.
std::string_view thousands_in(std::string_view text);

}  // namespace asperity
