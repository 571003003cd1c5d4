// SPDX-License-Identifier: GPL-3.0-or-later
// The events of a run as JSON lines, numbered from 1, in a file next to the run directory: long runs need no
// server memory. One writer, many readers.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "bindings/web/confined/confined_process.hpp"
#include "engine/core/files/json.hpp"

namespace asperity::web {

// Thread-safe.
class EventLog {
 public:
  explicit EventLog(std::filesystem::path file) : file_(std::move(file)) {}

  // Adds {"n":…, "type":…, fields}; false after the last event or if writing fails.
  bool add(const std::string& type, const Json& fields);
  void finish(const Json& fields);

  // About 64 KiB of lines after number `after`; waits for at most `patience`. `more` is false after the last
  // event.
  std::string after(std::int64_t& after, std::chrono::milliseconds patience, bool& more) const;
  std::int64_t bytes() const;

 private:
  bool append(const std::string& type, const Json& fields);

  const std::filesystem::path file_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  Descriptor writer_;
  std::vector<std::int64_t> ends_;  // end of each line
  bool finished_ = false;
};

}  // namespace asperity::web
