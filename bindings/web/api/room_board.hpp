// SPDX-License-Identifier: GPL-3.0-or-later
// What the people of a room have put up for its teacher: the numbers they predict in a lesson, and whether
// somebody asks for help. It is kept in memory, as long as the server runs, and bounded for each person.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <string>

#include "engine/core/files/json.hpp"

namespace asperity::web {

// Thread-safe.
class RoomBoard {
 public:
  static constexpr std::size_t longest_name = 60, most_lessons = 40, most_numbers = 12;

  // The numbers that this person predicts in that lesson, by name, instead of any before; none takes them
  // back. Throws Error{bad_value} where names or numbers are more or longer than above, or a number is not
  // finite.
  void predict(std::size_t person, const std::string& lesson, const std::map<std::string, double>& numbers);
  void ask_for_help(std::size_t person, bool wanted);

  // [{lesson, name, value}], by lesson and name.
  Json predictions_of(std::size_t person) const;
  bool needs_help(std::size_t person) const;

 private:
  struct Notes {
    std::map<std::string, std::map<std::string, double>> predictions;
    bool help = false;
  };

  mutable std::mutex mutex_;
  std::map<std::size_t, Notes> of_;
};

}  // namespace asperity::web
