// SPDX-License-Identifier: GPL-3.0-or-later
// Turns of people who share a few places: runs, moves of live scripts, checks, answers. The person with the
// least recent use is next: one person's long uses never block a short one; equal people alternate. Some
// places can be reserved for quick people.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace asperity::web {

struct TurnRules {
  int places = 1;
  int each = 1;                        // at most, per person
  bool one_while_others_wait = false;  // then one place each
  int for_quick = 0;                   // places for last uses of at most `quick`
  std::chrono::milliseconds quick{1000};
};

class Turns {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Turns(TurnRules rules) : rules_(rules) {}

  // Thread-safe. Waits for a turn; null after `patience`. The turn ends, before this object, with the last
  // copy.
  std::shared_ptr<void> take(std::size_t person, std::chrono::milliseconds patience);
  // Calls of take(). Thread-safe.
  std::size_t waiting() const;

  // For callers with a lock of their own. The person in `waiting` (no duplicates) who may begin, if any.
  std::optional<std::size_t> next(const std::vector<std::size_t>& waiting, Clock::time_point now) const;
  void begin(std::size_t person, Clock::time_point now);
  // `seconds`: of use.
  void end(std::size_t person, Clock::time_point begun, double seconds, Clock::time_point now);
  // Recent use, s: decays over 300 s; a current use counts.
  double used(std::size_t person, Clock::time_point now) const;

 private:
  struct Person {
    std::vector<Clock::time_point> uses;  // start of each current use
    double used = 0;                      // as of `at`
    Clock::time_point at{};
    std::size_t last_turn = 0;
    bool slow = false;
  };
  const Person& of(std::size_t person) const;
  bool may_begin(std::size_t person, bool others_wait) const;
  bool is_next(std::list<std::size_t>::iterator call);

  const TurnRules rules_;
  std::map<std::size_t, Person> people_;
  std::size_t turns_ = 0;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::list<std::size_t> calls_;  // persons who wait in take()
};

}  // namespace asperity::web
