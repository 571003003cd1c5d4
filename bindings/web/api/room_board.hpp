// SPDX-License-Identifier: GPL-3.0-or-later
// Predictions and requests for help in a classroom, for its teacher. In memory, bounded for each person.
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

  // Replaces the person's predictions for a lesson; empty `numbers` delete them. Throws Error{bad_value}
  // beyond these limits or for a non-finite number.
  void predict(std::size_t person, const std::string& lesson, const std::map<std::string, double>& numbers);
  void ask_for_help(std::size_t person, bool wanted);

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
