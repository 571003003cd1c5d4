// SPDX-License-Identifier: GPL-3.0-or-later
// The journal of a run: one line of JSON per event, {"n":<number from 1>,"event":<name>, <fields>}, written
// at once. Equal runs write equal lines; varying values (seconds) belong in a field "unhashed".
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/digest.hpp"
#include "engine/core/files/json.hpp"

namespace asperity {

struct JournalFacts {
  std::int64_t lines = 0;
  std::string digest;
  bool operator==(const JournalFacts&) const = default;
};
JournalFacts facts_of(const std::vector<Json>& lines);

// Thread-safe.
class Journal {
 public:
  Journal() = default;
  // Throws Error{bad_file} if the file exists or cannot be created.
  explicit Journal(std::filesystem::path path);
  // Resumes an interrupted run: removes a torn last line, everything after a hole from a power cut, and an
  // event "end"; later writes are compared with the remaining lines. Throws Error{bad_file} for an
  // inaccessible file, a link, or damage before the end.
  static std::unique_ptr<Journal> again(std::filesystem::path path);
  ~Journal();

  // Returns the line number. `fields`: object or null. Throws Error{bad_file} if the disk refuses (the file
  // then ends with the previous line), Error{bad_state} after close() and for a step other than the recorded
  // one.
  std::int64_t write(std::string_view event, const Json& fields = {});

  // Called in order, after each write.
  void watch(std::function<void(std::string_view event, const Json& fields)> watcher) {
    watcher_ = std::move(watcher);
  }

  std::int64_t count() const;
  bool repeating() const;
  // The first difference from the record; "" if none.
  std::string departure() const;
  const std::filesystem::path& path() const { return path_; }
  // Removed or replaced on disk.
  bool is_lost() const;
  // The closed file differs from the written lines.
  bool is_altered() const;
  // None before close(), without a file, and behind a blocked writer.
  std::optional<JournalFacts> facts() const;

  // Writes a last line; false if a writer is blocked longer than `patience`.
  bool close(std::string_view event, const Json& fields, std::chrono::milliseconds patience);

 private:
  std::int64_t append(std::string_view event, const Json& fields);
  bool repeats(const Json& line);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::int64_t count_ = 0;
  bool closed_ = false;
  std::vector<Json> recorded_;      // of a resumed journal
  std::vector<std::int64_t> ends_;  // byte after each line
  std::string departure_;
  Digester digester_;
  std::function<void(std::string_view, const Json&)> watcher_;
  mutable std::mutex mutex_;
};

// Lines without unhashed fields. `may_be_torn`: ignores text after the last newline, and everything from a
// line with zeros on. Throws Error{bad_file} for invalid JSON or a wrong line number.
struct JournalLines {
  std::vector<Json> lines;
  std::vector<std::int64_t> ends;
};
JournalLines read_journal(const std::filesystem::path& path, bool may_be_torn);

Json without(const Json& record, std::string_view member = "unhashed");

// Null where missing. At least one; without path if the records are not both objects or differ in order only.
struct DifferingMember {
  std::string path;  // "row.area"
  const Json *one, *other;
};
std::vector<DifferingMember> differing_members(const Json* one, const Json* other,
                                               const std::string& path = {});
// As JSON, cut after 120 bytes; "nothing" for null.
std::string brief(const Json* value);

}  // namespace asperity
