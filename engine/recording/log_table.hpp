// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of a press (statistics/table_lines.hpp). The first line that is neither blank nor a comment (#)
// names the columns in any order and case. Units are in titles, in the next line, in cells, or given. Times
// may be dates and times of day.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/files/source_file.hpp"
#include "engine/core/monitor.hpp"
#include "engine/core/quantity.hpp"
#include "engine/statistics/cell_column.hpp"
#include "engine/statistics/table_form.hpp"
#include "engine/statistics/table_head.hpp"
#include "engine/statistics/table_lines.hpp"

namespace asperity {

struct LogColumn {
  std::string_view name;
  int meaning;  // 0 … LogTable::most_meanings - 1
  Dimension dimension;
  std::string_view example;  // "time [s]"
};

// Collects problems until fail_if_any().
class LogTable {
 public:
  static constexpr std::size_t most_meanings = 8;

  // Arguments must outlive the table. Throws Error{bad_file} for bytes other than text.
  LogTable(const SourceFile& file, std::span<const LogColumn> known, const TableForm& form);

  // Throws Error{bad_file} for missing titles or units and repeated columns.
  void read_titles();
  // See TableLines.
  void read_rows(Monitor& monitor, const std::function<bool(std::vector<TableCell>&)>& take) {
    lines_.read_rows(monitor, problems_, take);
  }

  std::size_t columns() const { return columns_.size(); }
  // Null for an ignored column.
  const LogColumn* column(std::size_t k) const { return columns_[k].known; }
  std::optional<std::size_t> find(int meaning) const { return column_of_[static_cast<std::size_t>(meaning)]; }
  bool has(int meaning) const { return find(meaning).has_value(); }
  std::string others() const;
  void warn_of_others(Monitor& monitor) const;
  // A problem unless exactly one is given.
  void require_one_of(int pressure, int load);

  // In SI; an unreadable cell is a problem. `exactly`: rounded once.
  CellReading read(std::size_t k, const TableCell& cell, bool exactly);
  // Ambiguous commas, days of a spreadsheet.
  std::vector<std::string> warnings() const;

  void problem(const std::string& place, const std::string& finding) { problems_.add(place, finding); }
  std::size_t problems() const { return problems_.count(); }
  // With the first dozen problems in words.
  void fail_if_any() const { problems_.fail_if_any(); }

  std::size_t line() const { return lines_.line(); }
  std::string here() const { return lines_.here(); }
  std::string here(std::size_t column) const;

 private:
  struct Column : HeadedColumn {  // lower case
    const LogColumn* known = nullptr;
    std::optional<CellColumn> cells{};
  };
  void skip_preamble();
  void choose_columns();
  void refuse_unknown_names() const;
  void match_titles();
  const LogColumn* known_as(const Column& column, bool by_other_names, const std::string& below) const;
  void split_unit(Column& column) const;
  bool units_stand_below();
  void read_unit(std::size_t k, bool below_are_units);
  void read_without_unit(std::size_t k, const std::string& place);
  CellColumn stamps_of(std::size_t k);
  std::optional<std::string> meant(const Column& column) const;
  void refuse_other_forms() const;
  std::vector<std::string> known_names() const;
  std::size_t count_known(std::string_view titles) const;
  NumberForm form_of(std::size_t k, const std::string& text);
  std::string below(std::size_t k) const { return k < lines_.below().size() ? lines_.below()[k].text : ""; }

  const SourceFile& file_;
  std::span<const LogColumn> known_;
  const TableForm& form_;
  TableLines lines_;
  FileProblems problems_;
  std::vector<Column> columns_;
  std::array<std::optional<std::size_t>, most_meanings> column_of_{};
  std::vector<std::string> warnings_;
  NumberEvidence commas_{'\0', '\0'};  // read as decimal signs
};

// A hint if a time of day may lack its date.
std::string past_midnight(double seconds_back);

}  // namespace asperity
