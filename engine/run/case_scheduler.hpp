// SPDX-License-Identifier: GPL-3.0-or-later
// Distributes the cases of an ensemble over threads, shards and ranks of mpirun. The calling thread shows
// progress, output and warnings in the order of the cases. A case that ends during a stop has no result. With
// parallel cases the engine's own loops are single-threaded. Results have the same bits for any number of
// threads.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/monitor.hpp"

namespace asperity {

class Ranks;

// Process `index` of `count`, from 1, with a shared store.
struct Shard {
  int index = 1, count = 1;
  bool own(std::size_t k) const {
    return k % static_cast<std::size_t>(count) == static_cast<std::size_t>(index - 1);
  }
  std::string text() const { return std::to_string(index) + "/" + std::to_string(count); }
  bool operator==(const Shard&) const = default;
};

// Both from 1.
struct CaseNumber {
  int ensemble = 1;
  std::size_t number = 1;
};

// Derived classes add the result.
struct FinishedCase {
  virtual ~FinishedCase() = default;
  std::string failure;  // with traceback; empty: success
  std::string output;
  std::vector<std::string> warnings;
  double transforms = 0;
};

// Cases are numbered from 0. Thread-safe.
class EnsembleCases {
 public:
  using Finished = std::unique_ptr<FinishedCase>;
  virtual ~EnsembleCases() = default;
  virtual std::size_t count() const = 0;
  virtual std::string name(std::size_t k) const = 0;  // "case D = 2.5, seed = 3"
  virtual Finished compute(std::size_t k) = 0;
  // Makes running cases fail soon.
  virtual void interrupt() = 0;
  // failed() makes a failed case; fail() marks a computed one.
  virtual Finished failed(const std::string& why) const = 0;
  virtual void fail(FinishedCase& found, const std::string& why) const = 0;

  // From the store; null if missing, invalid, or a failure without `with_failures`.
  virtual Finished find_kept(std::size_t k, bool with_failures) const = 0;
  // Stores a failure only if `always`. Throws Error only if `always`.
  virtual void keep(std::size_t k, const FinishedCase& found, bool always) const = 0;

  // Throws Error{not_permitted} for a row without serial form, Error{bad_file} for foreign bytes.
  virtual std::string bytes(std::size_t k, const FinishedCase& found) const = 0;
  virtual Finished from_bytes(std::size_t k, std::string_view bytes) const = 0;
};

struct StoreReport {
  std::vector<std::size_t> missing;                         // cases
  std::vector<std::pair<std::size_t, std::string>> failed;  // own cases, and why
};

struct CaseSchedule {
  Monitor& monitor;
  int ensemble = 0;        // from 1
  Ranks* ranks = nullptr;  // null: this process alone
  // Cases computed here; the others come from the store. Empty: all.
  std::function<bool(std::size_t k)> own{};
  bool needs_others = true;  // with `own`: the script needs other rows
  std::function<void(std::string_view)> print{};
  // Called after the cases of `own`, else before the first case. May end the process. Empty: no shared store.
  std::function<void(const StoreReport& report)> report{};
};

// Results in order. A failed case only warns: failures do not depend on timing. Throws Error on a stop, after
// all cases have ended; Error{bad_state} if another rank reaches another ensemble.
std::vector<std::unique_ptr<FinishedCase>> run_cases(EnsembleCases& cases, const CaseSchedule& schedule);

}  // namespace asperity
