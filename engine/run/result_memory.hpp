// SPDX-License-Identifier: GPL-3.0-or-later
// Results of heavy calls in memory, under the keys of result_store.hpp: what a script that is run again with
// another knob, in one process, shares with its last run. However cheap a result was, it is kept; of what no
// longer fits, what was used longest ago goes first. May stand in front of a store on the disk.
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>

#include "engine/core/files/result_store.hpp"

namespace asperity {

// Thread-safe.
class ResultMemory final : public ResultStore {
 public:
  // At most so many bytes of results; 0 keeps none. `behind` is asked for what is not here, and given all
  // that is kept; it outlives the memory, and may be null.
  explicit ResultMemory(std::int64_t most_bytes, ResultStore* behind = nullptr)
      : most_bytes_(most_bytes), behind_(behind) {}

  std::optional<FoundResult> find(const std::string& key) override;
  void keep(const std::string& key, std::string_view call, const ResultFacts& facts,
            const KeptFields& fields) override;
  void clear();

  struct Counts {
    std::int64_t found = 0;    // here
    std::int64_t missed = 0;   // neither here nor behind
    std::int64_t dropped = 0;  // to make room
    std::int64_t bytes = 0;    // held now
  };
  Counts counts() const;

 private:
  struct Entry {
    std::string key;
    std::shared_ptr<const FoundResult> result;
    std::int64_t bytes;
  };
  void put(const std::string& key, std::shared_ptr<const FoundResult> result);
  void drop_last();

  const std::int64_t most_bytes_;
  ResultStore* const behind_;
  mutable std::mutex mutex_;  // of what follows
  std::list<Entry> entries_;  // what was used last stands first
  std::unordered_map<std::string, std::list<Entry>::iterator> places_;
  Counts counts_;
};

}  // namespace asperity
