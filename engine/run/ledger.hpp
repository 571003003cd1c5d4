// SPDX-License-Identifier: GPL-3.0-or-later
// Work and cost of a run by call and contact effect, without recorded inner calls, so lines add up. Lines of
// ensemble cases sum seconds over parallel threads and are not added.
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
  std::string call;  // "contact:press"
  bool in_case = false;
  std::int64_t calls = 0;
  Cost cost;  // without inner calls; bytes: maximum
};

struct LedgerReport {
  std::vector<LedgerLine> lines;                        // dearest first, cases last
  std::vector<std::pair<std::string, Cost>> by_effect;  // dearest first
  std::vector<std::string> effects_off;                 // not named by any contact
  double seconds = 0;                                   // of the run so far
  double transforms = 0;                                // of all lines
  std::int64_t bytes = 0;                               // maximum of the lines

  // The script, and unrecorded short calls.
  double unaccounted() const;
  std::string text() const;
  Json json() const;
};

class Ledger {
 public:
  void add(std::string_view call, bool in_case, const Cost& own);
  void add_effects(std::span<const std::pair<std::string, Cost>> by_effect);
  LedgerReport report() const;

 private:
  const std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  mutable std::mutex mutex_;
  std::vector<LedgerLine> lines_;
  std::vector<std::pair<std::string, Cost>> by_effect_;
};

class LedgerScope {
 public:
  // Shorter calls get a line only if `lasting`.
  static constexpr double shortest = 50e-6;  // s

  // Line "owner.call", or `call`. Both outlive the scope.
  LedgerScope(Ledger& ledger, std::string_view owner, std::string_view call, bool in_case, bool lasting);
  ~LedgerScope();
  // keep() always records a line, forget() never.
  void keep() { lasting_ = true; }
  void forget() { forgotten_ = true; }

 private:
  Ledger& ledger_;
  std::string_view owner_, call_;
  bool in_case_, lasting_, forgotten_ = false;
  LedgerScope* outer_;
  CostScope cost_;
  Cost inner_;  // of recorded inner calls
};

}  // namespace asperity
