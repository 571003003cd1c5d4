// SPDX-License-Identifier: GPL-3.0-or-later
// Store for results of heavy calls. A result depends only on the arguments of its call, the key. Calls find
// the store through their monitor. A stored result keeps its original cost, so all numbers are equal.
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

// Names are unique within each list.
struct ResultFacts {
  std::vector<std::pair<std::string, double>> numbers;
  std::vector<std::pair<std::string, std::string>> texts;
  Cost cost;
  bool however_cheap = false;  // even if recomputation is faster
  bool one_of_many = false;    // many share a file and a disk wait
  double least_seconds = 0;    // not stored below this cost
  // Time of the calling thread. Wall time would be long for cheap results on a busy machine.
  double processor_seconds = std::numeric_limits<double>::infinity();
};

using KeptFields = std::vector<std::pair<std::string, const Field*>>;

struct FoundResult : ResultFacts {
  std::vector<std::pair<std::string, Field>> fields;

  // Throw Error{internal} for unknown names.
  double number(std::string_view name) const;
  const std::string& text(std::string_view name) const;
  Field take(std::string_view name);
  KeptFields kept() const;
};

// Thread-safe.
class ResultStore {
 public:
  virtual ~ResultStore() = default;
  // None for unknown keys and damaged data.
  virtual std::optional<FoundResult> find(const std::string& key) = 0;
  // Never fails; the store reports lost results.
  virtual void keep(const std::string& key, std::string_view call, const ResultFacts& facts,
                    const KeptFields& fields) = 0;
};

template <class Result>
struct Costed {
  Result result;
  Cost cost;  // of the original computation
};

// Conversion to a record and back, exact to the last bit.
template <class Result>
struct ResultForm {
  std::string_view call;
  void (*write)(const Result& result, ResultFacts& facts, KeptFields& fields);
  Result (*read)(FoundResult& found);
};

// `key` is called only with a store. Transforms of a stored result count as if computed.
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
