// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of a table in a text file that the file itself does not say, or says in a way that may mean
// two things. Whatever is not said is found where only one reading is possible, and asked for where it is
// not.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/files/text_table.hpp"
#include "engine/statistics/time_stamp.hpp"

namespace asperity {

// Meaning of times that step back: a new day, or a change of local time by an hour.
enum class StepsBack { unsaid, midnight, winter_time };

struct TableForm {
  std::int64_t skip = 0;  // lines before the head
  // Own names of columns, each with the head in the file, with or without its unit.
  std::vector<std::pair<std::string, std::string>> names{};
  // Heads of a file that has none, in order.
  std::vector<std::string> heads{};
  // Units of columns, by their own names or by those in the file; "1" for plain numbers.
  std::vector<std::pair<std::string, std::string>> units{};
  std::vector<std::string> texts{};  // columns that hold texts, whatever their cells look like
  DateOrder dates = DateOrder::unsaid;
  ClockForm clock = ClockForm::unsaid;
  bool stamps_since_1970 = false;  // and not since the first one
  StepsBack steps_back = StepsBack::unsaid;
  char decimal = '\0';    // '.' or ','
  char thousands = '\0';  // '.', ',', ' ' or '\''
  std::optional<Separator> separator{};
};

}  // namespace asperity
