// SPDX-License-Identifier: GPL-3.0-or-later
// Column of dates and times in seconds since the first stamp or since 1970. All stamps have the same order of
// day and month; all or none have dates, and all or none have time zones.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/statistics/table_form.hpp"
#include "engine/statistics/time_stamp.hpp"

namespace asperity {

class StampColumn {
 public:
  explicit StampColumn(const TableForm& form)
      : order_(form.dates),
        clock_(form.clock),
        since_1970_(form.stamps_since_1970),
        steps_back_(form.steps_back) {}

  // Call for cells from the first on, before read(), until it returns true.
  bool learn(std::string_view cell);
  // An ambiguity and its remedy, if any.
  std::optional<std::string> doubt() const;

  struct Reading {
    std::optional<double> seconds;
    std::string complaint{};
    std::string warning{};  // first unexplained step back; follows the cell name
  };
  // Not for empty cells. The first cell is the origin unless counted since 1970.
  Reading read(std::string_view cell);

 private:
  void step(Reading& reading);

  DateOrder order_;
  ClockForm clock_;
  bool since_1970_;
  StepsBack steps_back_;
  double added_ = 0, gap_ = 0;  // s; `gap_`: last forward step
  std::optional<double> last_;
  bool warned_ = false, repeats_ = false;
  std::string unsaid_order_, unsaid_clock_;  // first ambiguous stamp
  std::optional<TimeStamp> first_;
};

}  // namespace asperity
