// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/api/room_board.hpp"

#include <cmath>

#include "engine/core/error.hpp"

namespace asperity::web {

void RoomBoard::predict(std::size_t person, const std::string& lesson,
                        const std::map<std::string, double>& numbers) {
  const auto check = [](const std::string& name) {
    if (name.size() > longest_name)
      throw Error(ErrorCode::bad_value, "a name has " + std::to_string(name.size()) + " bytes",
                  "give at most " + std::to_string(longest_name));
  };
  check(lesson);
  if (numbers.size() > most_numbers)
    throw Error(ErrorCode::bad_value, std::to_string(numbers.size()) + " numbers are predicted",
                "give at most " + std::to_string(most_numbers));
  for (const auto& [name, value] : numbers) {
    check(name);
    if (!std::isfinite(value))
      throw Error(ErrorCode::bad_value, "the prediction `" + name + "` is no finite number", "give a number");
  }
  const std::lock_guard lock(mutex_);
  auto& predictions = of_[person].predictions;
  if (numbers.empty()) {
    predictions.erase(lesson);
    return;
  }
  if (!predictions.contains(lesson) && predictions.size() >= most_lessons)
    throw Error(ErrorCode::bad_value, "there are predictions of " + std::to_string(most_lessons) + " lessons",
                "take some back");
  predictions[lesson] = numbers;
}

void RoomBoard::ask_for_help(std::size_t person, bool wanted) {
  const std::lock_guard lock(mutex_);
  of_[person].help = wanted;
}

Json RoomBoard::predictions_of(std::size_t person) const {
  Json::List list;
  const std::lock_guard lock(mutex_);
  if (const auto found = of_.find(person); found != of_.end())
    for (const auto& [lesson, numbers] : found->second.predictions)
      for (const auto& [name, value] : numbers)
        list.push_back(Json::object({{"lesson", lesson}, {"name", name}, {"value", value}}));
  return list;
}

bool RoomBoard::needs_help(std::size_t person) const {
  const std::lock_guard lock(mutex_);
  const auto found = of_.find(person);
  return found != of_.end() && found->second.help;
}

}  // namespace asperity::web
