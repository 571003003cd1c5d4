// SPDX-License-Identifier: GPL-3.0-or-later
// Whose run is next, of people who share a few places to run. Nobody holds all places, and only one while
// somebody else waits; of those who may begin, it is the one who used least processor time lately. So a short
// run is never kept waiting by one person's long ones, as long as there is more than one place.
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

  // `shared`: there is more than one person; else all places are for the one there is.
  Turns(int places, bool shared) : places_(places), shared_(shared) {}

  // Who of those that wait, each named once, may begin now; none where nobody may.
  std::optional<std::size_t> next(const std::vector<std::size_t>& waiting, Clock::time_point now) const;
  // One run of that person begins; it ends, after so many seconds of processor time.
  void begin(std::size_t person, Clock::time_point now);
  void end(std::size_t person, Clock::time_point begun, double processor_seconds, Clock::time_point now);

  // Seconds of processor time of late: those of some minutes ago count e times less. A run that goes on
  // counts as if it used one processor.
  double used(std::size_t person, Clock::time_point now) const;

 private:
  struct Person {
    std::vector<Clock::time_point> running;  // when each began
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
