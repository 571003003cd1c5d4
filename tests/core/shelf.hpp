// SPDX-License-Identifier: GPL-3.0-or-later
// Results stored in memory, and their monitor.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/files/result_store.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

class Shelf final : public ResultStore {
 public:
  std::optional<FoundResult> find(const std::string& key) override {
    const auto known = results.find(key);
    if (known == results.end()) return {};
    ++found;
    FoundResult copy;
    static_cast<ResultFacts&>(copy) = known->second;
    copy.fields = known->second.fields;
    return copy;
  }
  void keep(const std::string& key, std::string_view, const ResultFacts& facts,
            const KeptFields& fields) override {
    FoundResult& kept = results[key];
    static_cast<ResultFacts&>(kept) = facts;
    for (const auto& [name, field] : fields) kept.fields.emplace_back(name, *field);
  }
  std::map<std::string, FoundResult> results;
  int found = 0;
};

class ShelfMonitor final : public Monitor {
 public:
  explicit ShelfMonitor(Shelf& shelf) : shelf_(shelf) {}
  void progress(std::string_view, double) override {}
  void warn(std::string_view) override {}
  ResultStore* results() override { return &shelf_; }

 private:
  Shelf& shelf_;
};

}  // namespace asperity
