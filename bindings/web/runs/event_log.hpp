// SPDX-License-Identifier: GPL-3.0-or-later
// The events of one run, numbered from 1, as lines of JSON in a file beside its directory, so that a run of
// many rows costs the server no memory. One writes, any number read, wait for more, and come back later.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "bindings/web/sandbox/confined_process.hpp"
#include "engine/core/files/json.hpp"

namespace asperity::web {

// Thread-safe.
class EventLog {
 public:
  explicit EventLog(std::filesystem::path file) : file_(std::move(file)) {}

  // Adds {"n":…, "type":…, fields}; returns false, and keeps nothing, after the last or where the disk
  // refuses.
  bool add(const std::string& type, const Json& fields);
  // Adds the last one.
  void finish(const Json& fields);

  // The lines after number `after`, as many as fit into a piece of some 64 KiB; waits for one at most so
  // long. `more` is false once the last has been given.
  std::string after(std::int64_t& after, std::chrono::milliseconds patience, bool& more) const;
  // Bytes so far.
  std::int64_t bytes() const;

 private:
  bool append(const std::string& type, const Json& fields);

  const std::filesystem::path file_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  Descriptor writer_;
  std::vector<std::int64_t> ends_;  // byte after each
  bool finished_ = false;
};

}  // namespace asperity::web
