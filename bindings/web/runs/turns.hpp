// SPDX-License-Identifier: GPL-3.0-or-later
// Turns of people who share a few places. Nobody holds all places, and only one while somebody else waits.
// The person with the least recent processor time is next, so that one person's long runs never block a short
// run.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

namespace asperity::web {

// Not thread-safe.
class Turns {
 public:
  using Clock = std::chrono::steady_clock;

  // `shared`: several people; a single person may use all places.
  Turns(int places, bool shared) : places_(places), shared_(shared) {}

  // The person in `waiting` (no duplicates) who may begin; none if nobody may.
  std::optional<std::size_t> next(const std::vector<std::size_t>& waiting, Clock::time_point now) const;
  void begin(std::size_t person, Clock::time_point now);
  void end(std::size_t person, Clock::time_point begun, double processor_seconds, Clock::time_point now);

  // Recent processor time, s: decays over 300 s; a current run counts as one processor.
  double used(std::size_t person, Clock::time_point now) const;

 private:
  struct Person {
    std::vector<Clock::time_point> running;  // start of each run
    double used = 0;                         // as of `at`
    Clock::time_point at{};
    std::size_t last_turn = 0;
  };
  std::size_t running(std::size_t person) const;
  std::size_t last_turn(std::size_t person) const;

  int places_;
  bool shared_;
  std::map<std::size_t, Person> people_;
  std::size_t turns_ = 0;
};

}  // namespace asperity::web
