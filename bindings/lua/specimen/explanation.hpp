// SPDX-License-Identifier: GPL-3.0-or-later
// Plan of a script without its solves: surfaces are made, contacts planned, and each press noted with its
// plan. Contacts with equal plans are shown once. A loop over a sweep runs once; an ensemble runs its first
// case for all.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/contact/plan.hpp"
#include "engine/contact/scene/press_request.hpp"
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
  // For example "contact:press"; if `named` is empty, `presses` unknown presses.
  void note(const SpecimenPair& pair, const std::string& what, std::span<const Asked> named,
            std::int64_t presses = 1);

  // Without a plan: the contact is unknown before the run, or spread over ranks.
  void note_unplanned(const std::string& what) { unplanned_[what] += times_; }

  // Multiplies the counts noted during its lifetime.
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

  std::string text() const;  // lines with line ends
  Json json() const;

 private:
  struct Expected {
    double transforms = 0, seconds = 0;
  };
  // Presses with one plan and control; `by` is empty if unknown.
  struct Calls {
    std::string what;
    std::optional<PressBy> by;
    std::int64_t times = 0;
    Expected all;  // sum over all presses
    std::map<double, Expected> tried{};
    double least = std::numeric_limits<double>::infinity(), most = 0;  // transforms of one press
  };
  struct Planned {
    Plan plan;
    std::string text;
    std::vector<Calls> calls{};
  };
  Calls& calls_of(Planned& planned, const std::string& what, std::optional<PressBy> by);
  static Expected expected(const SpecimenPair& pair, const PressRequest& request, Calls& calls);

  std::vector<Planned> planned_;
  std::map<std::string, std::int64_t> unplanned_;
  std::int64_t times_ = 1;
};

// For skipped heavy calls.
void note_call(Explanation& explanation, const Call& call, const Function& function);

}  // namespace asperity::lua
