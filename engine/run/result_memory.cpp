// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/result_memory.hpp"

#include <optional>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

namespace {

std::int64_t bytes_of_result(const std::string& key, const FoundResult& result) {
  constexpr std::size_t each = 64;  // approximate overhead of an item
  std::size_t bytes = 4 * each + 2 * key.size();
  for (const auto& [name, value] : result.numbers) bytes += each + name.size();
  for (const auto& [name, text] : result.texts) bytes += each + name.size() + text.size();
  for (const auto& [name, field] : result.fields) bytes += each + name.size() + field.size() * sizeof(double);
  return static_cast<std::int64_t>(bytes);
}

// Checked before a copy, because a refused copy counts against the run.
bool has_room(std::int64_t bytes) {
  const std::int64_t limit = memory::limit();
  return limit == 0 || memory::held() + bytes <= limit;
}

}  // namespace

std::optional<FoundResult> ResultMemory::find(const std::string& key) {
  std::shared_ptr<const FoundResult> known;
  {
    const std::lock_guard lock(mutex_);
    if (const auto at = places_.find(key); at != places_.end()) {
      entries_.splice(entries_.begin(), entries_, at->second);
      known = at->second->result;
      ++counts_.found;
    }
  }
  if (known != nullptr) {
    // Results can be recomputed: free their memory for the copy.
    if (!has_room(bytes_of_result(key, *known))) clear();
    return *known;
  }
  std::optional<FoundResult> found = behind_ != nullptr ? behind_->find(key) : std::nullopt;
  if (!found) {
    const std::lock_guard lock(mutex_);
    ++counts_.missed;
    return {};
  }
  if (has_room(bytes_of_result(key, *found))) put(key, std::make_shared<const FoundResult>(*found));
  return found;
}

void ResultMemory::keep(const std::string& key, std::string_view call, const ResultFacts& facts,
                        const KeptFields& fields) {
  std::int64_t bytes = 0;
  for (const auto& [name, field] : fields) bytes += static_cast<std::int64_t>(field->size() * sizeof(double));
  if (bytes <= most_bytes_ && has_room(bytes)) {
    FoundResult result;
    static_cast<ResultFacts&>(result) = facts;
    for (const auto& [name, field] : fields) result.fields.emplace_back(name, *field);
    put(key, std::make_shared<const FoundResult>(std::move(result)));
  } else if (bytes <= most_bytes_) {
    clear();  // as in find()
  }
  if (behind_ != nullptr) behind_->keep(key, call, facts, fields);
}

void ResultMemory::put(const std::string& key, std::shared_ptr<const FoundResult> result) {
  const std::int64_t bytes = bytes_of_result(key, *result);
  const std::lock_guard lock(mutex_);
  if (const auto at = places_.find(key); at != places_.end()) {
    counts_.bytes -= at->second->bytes;
    entries_.erase(at->second);
    places_.erase(at);
  }
  if (bytes > most_bytes_) return;
  while (counts_.bytes + bytes > most_bytes_) drop_last();
  entries_.push_front({key, std::move(result), bytes});
  places_.emplace(key, entries_.begin());
  counts_.bytes += bytes;
}

void ResultMemory::drop_last() {
  counts_.bytes -= entries_.back().bytes;
  places_.erase(entries_.back().key);
  entries_.pop_back();
  ++counts_.dropped;
}

void ResultMemory::clear() {
  const std::lock_guard lock(mutex_);
  places_.clear();
  entries_.clear();
  counts_.bytes = 0;
}

ResultMemory::Counts ResultMemory::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

}  // namespace asperity
