// SPDX-License-Identifier: GPL-3.0-or-later
// The cases of an ensemble, spread over the threads of a process, over the shards of a run and over the ranks
// of mpirun. Threads take cases in order; the calling thread waits, shows progress, what cases printed and
// warned of in the order of the cases, and carries a stop to the cases that run. A case that ends while its
// process is being stopped has no result. Stored cases are taken from the store; a shard takes those of
// others there as well. With more than one thread the engine's own loops stay on the thread of their case;
// results are the same bits for any number. The caller defines and computes the cases.
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

// Process `index` of `count`, counted from 1, which run the same script and share a store: cases k = index -
// 1 modulo `count` are its own.
struct Shard {
  int index = 1, count = 1;
  bool own(std::size_t k) const {
    return k % static_cast<std::size_t>(count) == static_cast<std::size_t>(index - 1);
  }
  std::string text() const { return std::to_string(index) + "/" + std::to_string(count); }
  bool operator==(const Shard&) const = default;
};

// Case `number` of ensemble `ensemble` of the run, both counted from 1.
struct CaseNumber {
  int ensemble = 1;
  std::size_t number = 1;
};

// What the scheduler reads of a case that was computed; whoever computes it adds what it found.
struct FinishedCase {
  virtual ~FinishedCase() = default;
  std::string failure;  // why it failed, with a traceback of the script below; empty: it did not
  std::string output;   // what it printed
  std::vector<std::string> warnings;
  double transforms = 0;
};

// The cases of one ensemble, numbered from 0. Called from several threads at once.
class EnsembleCases {
 public:
  using Finished = std::unique_ptr<FinishedCase>;
  virtual ~EnsembleCases() = default;
  virtual std::size_t count() const = 0;
  virtual std::string name(std::size_t k) const = 0;  // "case D = 2.5, seed = 3"
  // An error in a case is its failure.
  virtual Finished compute(std::size_t k) = 0;
  // Makes the cases that run fail as soon as they can.
  virtual void interrupt() = 0;
  // A case that found nothing, for this reason; and one whose row counts no longer.
  virtual Finished failed(const std::string& why) const = 0;
  virtual void fail(FinishedCase& found, const std::string& why) const = 0;

  // From the store; null where it is missing or no longer holds. A failure counts only `with_failures`.
  virtual Finished find_kept(std::size_t k, bool with_failures) const = 0;
  // Failures are kept only where `always`. Throws Error where `always` and it cannot be kept.
  virtual void keep(std::size_t k, const FinishedCase& found, bool always) const = 0;

  // For other processes. Throws Error{not_permitted} for what bytes cannot carry, Error{bad_file} for bytes
  // that bytes() did not write.
  virtual std::string bytes(std::size_t k, const FinishedCase& found) const = 0;
  virtual Finished from_bytes(std::size_t k, std::string_view bytes) const = 0;
};

// Missing and failed cases of an ensemble in the shared store.
struct StoreReport {
  std::vector<std::size_t> missing;                         // cases
  std::vector<std::pair<std::size_t, std::string>> failed;  // own cases, and why
};

struct CaseSchedule {
  Monitor& monitor;
  int ensemble = 0;        // of the run, counted from 1
  Ranks* ranks = nullptr;  // the processes that share the cases; null: this one alone
  // Which cases this process computes, where it takes those of other processes from the store; empty: all.
  std::function<bool(std::size_t k)> own{};
  bool needs_others = true;  // with `own`: whether the script goes on, and so needs the other rows
  // What cases printed, in their order.
  std::function<void(std::string_view)> print{};
  // Called with the missing and failed cases: after the cases of `own`, or else before the first case. It may
  // end the process. Empty: no other run uses the store.
  std::function<void(const StoreReport& report)> report{};
};

// The results of all cases, in their order. A failed case gives a warning and the others run on, so
// that which ones fail does not depend on timing. Throws Error when the run is to stop, after every case has
// ended, and Error{bad_state} where another rank comes to another ensemble.
std::vector<std::unique_ptr<FinishedCase>> run_cases(EnsembleCases& cases, const CaseSchedule& schedule);

}  // namespace asperity
