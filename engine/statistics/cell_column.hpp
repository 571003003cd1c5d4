// SPDX-License-Identifier: GPL-3.0-or-later
// A column of cells in SI units: numbers in the column's unit, quantities with their own units, days of a
// spreadsheet, or dates and times. Days and stamps become seconds since the first one or since 1970.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "engine/core/quantity.hpp"
#include "engine/statistics/number_form.hpp"
#include "engine/statistics/table_form.hpp"
#include "engine/statistics/time_stamp.hpp"

namespace asperity {

struct CellReading {
  CellKind kind = CellKind::unreadable;
  double value = 0;
  std::string complaint{};  // begins with the unreadable cell
  std::string warning{};    // follows the cell
};

// All stamps have one order of day and month; all or none have dates, and all or none time zones.
class StampColumn {
 public:
  explicit StampColumn(TableForm form) : form_(std::move(form)) {}

  // Call before read() for cells from the first on, until it returns true.
  bool learn(std::string_view cell);
  // An ambiguity and its remedy, if any.
  std::optional<std::string> doubt() const;

  // In s. Not for empty cells. Warns of the first unexplained step back.
  CellReading read(std::string_view cell);

 private:
  void step(CellReading& reading);

  TableForm form_;              // with learnt order of dates
  double added_ = 0, gap_ = 0;  // s; `gap_`: last forward step
  std::optional<double> last_;
  bool warned_ = false, repeats_ = false;
  std::string unsaid_order_, unsaid_clock_;  // first ambiguous stamp
  std::optional<TimeStamp> first_;
};

class CellColumn {
 public:
  enum class Kind { numbers, quantities, days, stamps };
  // `unit`: of numbers, known to parse_unit, or "". `dimension` of quantities: nothing for that of the first
  // cell.
  CellColumn(Kind kind, std::string unit, std::optional<Dimension> dimension, const TableForm& form);

  Kind kind() const { return kind_; }
  Dimension dimension() const { return dimension_.value_or(dimension::number); }
  StampColumn& stamps() { return stamps_; }

  // `exactly`: rounded once with their unit, as in a script.
  CellReading read(const std::string& text, const NumberForm& form, bool exactly);

 private:
  CellReading other_than_number(const std::string& text, CellKind kind);
  double day(double number);

  Kind kind_;
  std::string unit_;
  double factor_ = 1;
  std::optional<Dimension> dimension_;
  bool since_1970_;
  std::optional<double> first_day_;
  StampColumn stamps_;
};

}  // namespace asperity
