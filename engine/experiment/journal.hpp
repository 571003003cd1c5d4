// SPDX-License-Identifier: GPL-3.0-or-later
// The journal of a run: one line of JSON an event, each handed to the system in one piece as it
// happens, so that a run that is killed loses nothing it had recorded. A line is
// {"n":<number from 1>,"event":<name>, <fields>}. It carries no dates: equal runs write equal lines;
// what differs from run to run (seconds) belongs in a field named "unhashed".
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string_view>

#include "engine/experiment/json.hpp"

namespace asperity {

// Thread-safe.
class Journal {
 public:
  // Keeps nothing but the count.
  Journal() = default;
  // Makes the file. Throws Error{bad_file} if it cannot or the file exists already.
  explicit Journal(std::filesystem::path path);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  // Returns the number of the line. `fields` is an object or null. Throws Error{bad_file} when the
  // disk refuses (the file then ends with the line before), Error{bad_state} after close().
  std::int64_t write(std::string_view event, const Json& fields = {});

  // Lines written.
  std::int64_t count() const;
  const std::filesystem::path& path() const { return path_; }

  // Writes a last line and refuses all later ones. Waits at most `patience` for a writer that is
  // stuck in the disk; returns false, with every earlier line whole, if that was not enough.
  bool close(std::string_view event, const Json& fields, std::chrono::milliseconds patience);

 private:
  std::int64_t append(std::string_view event, const Json& fields);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::int64_t count_ = 0;
  bool closed_ = false;
  mutable std::mutex mutex_;
};

}  // namespace asperity
