// SPDX-License-Identifier: GPL-3.0-or-later
// What a run has done and what it cost: call by call, and for contacts effect by effect. A call's seconds and
// transforms are its own, without those of recorded calls it made, so that the lines add up; what is left of
// the run's time is the script itself and calls too short to matter. Cases of an ensemble run beside
// each other: their lines are kept apart, in seconds of all threads together, and are not added.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/cost.hpp"
#include "engine/core/files/json.hpp"

namespace asperity {

struct LedgerLine {
  std::string call;      // "contact:press"
  bool in_case = false;  // made by a case of an ensemble
  std::int64_t calls = 0;
  Cost cost;  // its own; bytes is the greatest of one call
};

struct LedgerReport {
  std::vector<LedgerLine> lines;                        // dearest first, those of cases last
  std::vector<std::pair<std::string, Cost>> by_effect;  // of all contacts pressed, dearest first
  std::vector<std::string> effects_off;                 // that no contact named
  double seconds = 0;                                   // of the run so far
  double transforms = 0;                                // of all lines
  std::int64_t bytes = 0;                               // greatest of the lines

  // Seconds of the run that are in no line: the script itself, and calls too short for one.
  double unaccounted() const;
  std::string text() const;  // several lines, each ended
  Json json() const;
};

class Ledger {
 public:
  void add(std::string_view call, bool in_case, const Cost& own);
  // What a contact's state cost, by effect.
  void add_effects(std::span<const std::pair<std::string, Cost>> by_effect);
  LedgerReport report() const;

 private:
  const std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  mutable std::mutex mutex_;
  std::vector<LedgerLine> lines_;
  std::vector<std::pair<std::string, Cost>> by_effect_;
};

// One call, from construction to destruction, on one thread.
class LedgerScope {
 public:
  // A call that is not `lasting` gets a line only if it takes longer than this.
  static constexpr double shortest = 50e-6;  // s

  // `owner` may be empty: the line is then that of `call`, otherwise "owner.call". Both outlive the scope.
  LedgerScope(Ledger& ledger, std::string_view owner, std::string_view call, bool in_case, bool lasting);
  ~LedgerScope();
  // Gives it a line however short it is; or none, however long.
  void keep() { lasting_ = true; }
  void forget() { forgotten_ = true; }
  LedgerScope(const LedgerScope&) = delete;
  LedgerScope& operator=(const LedgerScope&) = delete;

 private:
  Ledger& ledger_;
  std::string_view owner_, call_;
  bool in_case_, lasting_, forgotten_ = false;
  LedgerScope* outer_;
  CostScope cost_;
  Cost inner_;  // of recorded calls made from here
};

}  // namespace asperity
