// SPDX-License-Identifier: GPL-3.0-or-later
// The store of results of heavy calls. A result depends on nothing but the arguments of its call, and is
// stored under a key made of all of them, so that a run that makes the same call again reads the result
// instead of computing it. A call finds the store of its run through its monitor; where there is none it
// computes, and pays nothing. A stored result carries the cost it had when it was computed: every number is
// the same either way.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/cost.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// What is kept of a result beside its fields. Names are unique within each list.
struct ResultFacts {
  std::vector<std::pair<std::string, double>> numbers;
  std::vector<std::pair<std::string, std::string>> texts;
  Cost cost;
  bool however_cheap = false;  // to be kept even if it would be quicker computed again
  bool one_of_many = false;    // small, and one of thousands: they share a file, and a wait for the disk
  double least_seconds = 0;    // not worth a file if it cost less, whatever the store thinks
  // What the calling thread itself spent, where that is known: on a machine that others use as well, a cheap
  // result that took long is still cheap.
  double processor_seconds = std::numeric_limits<double>::infinity();
};

struct FoundResult : ResultFacts {
  std::vector<std::pair<std::string, Field>> fields;

  // Throw Error{internal} where there is none of that name.
  double number(std::string_view name) const;
  const std::string& text(std::string_view name) const;
  Field take(std::string_view name);
};

using KeptFields = std::vector<std::pair<std::string, const Field*>>;

// Thread-safe.
class ResultStore {
 public:
  virtual ~ResultStore() = default;
  // None where the key is unknown or what was kept under it is damaged.
  virtual std::optional<FoundResult> find(const std::string& key) = 0;
  // `call` tells a reader what made it. Never fails: what cannot be kept is lost, and the store says so.
  virtual void keep(const std::string& key, std::string_view call, const ResultFacts& facts,
                    const KeptFields& fields) = 0;
};

template <class Result>
struct Costed {
  Result result;
  Cost cost;  // of computing it, now or then
};

// How a kind of result goes into a record and comes out of it again, to the last bit.
template <class Result>
struct ResultForm {
  std::string_view call;
  void (*write)(const Result& result, ResultFacts& facts, KeptFields& fields);
  Result (*read)(FoundResult& found);
};

// The result under `key()`, or else that of `compute`, which is kept. `key` is asked for only where there is
// a store. Transforms are counted as of a result computed here.
template <class Result, class Key, class Compute>
Costed<Result> recall_or(Monitor& monitor, const ResultForm<Result>& form, Key key, Compute compute) {
  ResultStore* store = monitor.results();
  std::string name;
  if (store != nullptr) {
    name = key();
    if (std::optional<FoundResult> found = store->find(name)) {
      cost::count_transforms(found->cost.transforms);
      const Cost spent = found->cost;
      return {form.read(*found), spent};
    }
  }
  const CostScope scope;
  const double before = cost::processor_seconds();
  Costed<Result> fresh{compute(), {}};
  fresh.cost = scope.so_far();
  if (store != nullptr) {
    ResultFacts facts;
    facts.cost = fresh.cost;
    facts.processor_seconds = cost::processor_seconds() - before;
    KeptFields fields;
    form.write(fresh.result, facts, fields);
    store->keep(name, form.call, facts, fields);
  }
  return fresh;
}

}  // namespace asperity
