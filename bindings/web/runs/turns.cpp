// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/runs/turns.hpp"

#include <algorithm>
#include <cmath>

namespace asperity::web {

namespace {

constexpr double memory_seconds = 300;

double seconds_between(Turns::Clock::time_point from, Turns::Clock::time_point to) {
  return std::max(0.0, std::chrono::duration<double>(to - from).count());
}

}  // namespace

std::size_t Turns::running(std::size_t person) const {
  const auto known = people_.find(person);
  return known == people_.end() ? 0 : known->second.running.size();
}

std::size_t Turns::last_turn(std::size_t person) const {
  const auto known = people_.find(person);
  return known == people_.end() ? 0 : known->second.last_turn;
}

double Turns::used(std::size_t person, Clock::time_point now) const {
  const auto known = people_.find(person);
  if (known == people_.end()) return 0;
  double seconds = known->second.used * std::exp(-seconds_between(known->second.at, now) / memory_seconds);
  for (const Clock::time_point begun : known->second.running) seconds += seconds_between(begun, now);
  return seconds;
}

std::optional<std::size_t> Turns::next(const std::vector<std::size_t>& waiting, Clock::time_point now) const {
  const std::size_t most = static_cast<std::size_t>(!shared_             ? places_
                                                    : waiting.size() > 1 ? 1
                                                                         : std::max(1, places_ - 1));
  std::optional<std::size_t> best;
  double least = 0;
  for (const std::size_t person : waiting) {
    if (running(person) >= most) continue;
    const double seconds = used(person, now);
    // Equal use: alternate.
    if (best && !(seconds < least || (seconds == least && last_turn(person) < last_turn(*best)))) continue;
    best = person;
    least = seconds;
  }
  return best;
}

void Turns::begin(std::size_t person, Clock::time_point now) {
  Person& known = people_[person];
  known.running.push_back(now);
  known.last_turn = ++turns_;
}

void Turns::end(std::size_t person, Clock::time_point begun, double processor_seconds,
                Clock::time_point now) {
  Person& known = people_[person];
  if (const auto at = std::ranges::find(known.running, begun); at != known.running.end())
    known.running.erase(at);
  known.used = known.used * std::exp(-seconds_between(known.at, now) / memory_seconds) + processor_seconds;
  known.at = now;
}

}  // namespace asperity::web
