// SPDX-License-Identifier: GPL-3.0-or-later
// What a script will compute, found by running it without its solves: surfaces are made, contacts are
// planned, and each press that the script comes to is noted with its plan. Contacts of the same plan are
// shown once. A loop over a sweep turns once, and an ensemble runs its first case, which stands for all of
// them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/contact/plan.hpp"
#include "engine/core/files/json.hpp"

namespace asperity::lua {

class Call;
struct Function;

class Explanation {
 public:
  // A call that solves this plan; in `what`'s words, "contact:press".
  void note(const Plan& plan, const std::string& what, std::int64_t solves = 1);

  // A press of a contact of which nothing is known before it is made, or that lies over ranks.
  void note_unplanned(const std::string& what) { unplanned_[what] += times_; }

  // What is noted while it lives is done so many times.
  class Repeating {
   public:
    Repeating(Explanation* explanation, std::int64_t times);
    ~Repeating();
    Repeating(const Repeating&) = delete;
    Repeating& operator=(const Repeating&) = delete;

   private:
    Explanation* explanation_;  // may be null
    std::int64_t outer_ = 1;
  };

  std::string text() const;  // several lines, each ended
  Json json() const;

 private:
  struct Planned {
    Plan plan;
    std::vector<std::pair<std::string, std::int64_t>> calls;
    std::int64_t solves() const;
  };
  std::vector<Planned> planned_;
  std::map<std::string, std::int64_t> unplanned_;
  std::int64_t times_ = 1;
};

// Notes a heavy call that a dry run leaves out, with the presses it would make.
void note_call(Explanation& explanation, const Call& call, const Function& function);

}  // namespace asperity::lua
