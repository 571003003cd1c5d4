// SPDX-License-Identifier: GPL-3.0-or-later
// A column of dates and times of day as seconds since the first stamp, or since 1970: one order of day and
// month for all, all with dates or none, all with a time zone or none.
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

  // To be shown the column from its first cell on, before any is read, until it returns true: whether nothing
  // more is to be learned. Cells that are no stamps tell nothing.
  bool learn(std::string_view cell);
  // What cannot be known of the stamps that were shown, and how to say it; nothing where all is known.
  std::optional<std::string> doubt() const;

  struct Reading {
    std::optional<double> seconds;
    std::string complaint{};  // where there are none
    std::string warning{};    // for the first unexplained step back; follows the name of the cell
  };
  // A cell that is not empty. The first one that is read is the beginning unless they count since 1970.
  Reading read(std::string_view cell);

 private:
  // Adds days at midnight or hours at a change of local time.
  void step(Reading& reading);

  DateOrder order_;
  ClockForm clock_;
  bool since_1970_;
  StepsBack steps_back_;
  double added_ = 0, gap_ = 0;  // s; the last step that went forward
  std::optional<double> last_;
  bool warned_ = false, repeats_ = false;
  std::string unsaid_order_, unsaid_clock_;  // the first stamp of such kind
  std::optional<TimeStamp> first_;
};

}  // namespace asperity
