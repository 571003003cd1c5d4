// SPDX-License-Identifier: GPL-3.0-or-later
// Results of heavy calls of any cost, for repeated runs in one process. Drops the least recently used. May
// precede a store on the disk.
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
  // `most_bytes` 0 stores nothing. `behind` is searched on a miss and gets every result; it outlives the
  // memory; may be null.
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
    std::int64_t bytes = 0;
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
  mutable std::mutex mutex_;  // guards all below
  std::list<Entry> entries_;  // most recently used first
  std::unordered_map<std::string, std::list<Entry>::iterator> places_;
  Counts counts_;
};

}  // namespace asperity
