// SPDX-License-Identifier: GPL-3.0-or-later
// What a script will compute, found by running it without its solves: surfaces are made, contacts are
// planned, and each press that the script comes to is noted with its plan. Contacts of the same plan are
// shown once, and a press of one stands for that press of the others. A loop over a sweep turns once, and an
// ensemble runs its first case, which stands for all of them. Transforms are those of the very presses where
// the script says which they are.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/contact/plan.hpp"
#include "engine/contact/press_request.hpp"
#include "engine/core/files/json.hpp"
#include "engine/specimen/specimen_pair.hpp"

namespace asperity::lua {

class Call;
struct Function;

class Explanation {
 public:
  struct Asked {
    PressRequest request;
    std::int64_t times = 1;
  };
  // A call, `what` in its words ("contact:press"), that presses the pair as `named` says; `presses` times
  // where that is not known and `named` is empty.
  void note(const SpecimenPair& pair, const std::string& what, std::span<const Asked> named,
            std::int64_t presses = 1);

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
  struct Expected {
    double transforms = 0, seconds = 0;
  };
  // Presses of one plan by one control, or by none that is known.
  struct Calls {
    std::string what;
    std::optional<PressBy> by;
    std::int64_t times = 0;
    Expected all;  // of them together
    std::map<double, Expected> tried{};
    double least = std::numeric_limits<double>::infinity(), most = 0;  // transforms of one
  };
  struct Planned {
    Plan plan;
    std::string text;
    std::vector<Calls> calls{};
    std::int64_t solves() const;
    Expected together() const;
  };
  Calls& calls_of(Planned& planned, const std::string& what, std::optional<PressBy> by);
  static Expected expected(const SpecimenPair& pair, const PressRequest& request, Calls& calls);

  std::vector<Planned> planned_;
  std::map<std::string, std::int64_t> unplanned_;
  std::int64_t times_ = 1;
};

// Notes a heavy call that a dry run leaves out, with the presses it would make.
void note_call(Explanation& explanation, const Call& call, const Function& function);

}  // namespace asperity::lua
