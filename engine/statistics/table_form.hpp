// SPDX-License-Identifier: GPL-3.0-or-later
// User's statements about a table file. Unstated properties are inferred; an ambiguous property is an error.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/files/text_table.hpp"
#include "engine/statistics/time_stamp.hpp"

namespace asperity {

// New day, or clock change.
enum class StepsBack { unsaid, midnight, winter_time };

struct TableForm {
  std::int64_t skip = 0;  // lines before the head
  // New names with heads in the file.
  std::vector<std::pair<std::string, std::string>> names{};
  // For a file without heads, in order.
  std::vector<std::string> heads{};
  // By either name; "1" for plain numbers.
  std::vector<std::pair<std::string, std::string>> units{};
  std::vector<std::string> texts{};
  DateOrder dates = DateOrder::unsaid;
  ClockForm clock = ClockForm::unsaid;
  bool stamps_since_1970 = false;  // else since the first stamp
  StepsBack steps_back = StepsBack::unsaid;
  char decimal = '\0';    // '.' or ','
  char thousands = '\0';  // '.', ',', ' ' or '\''
  std::optional<Separator> separator{};
};

}  // namespace asperity
