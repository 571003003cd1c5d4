// SPDX-License-Identifier: GPL-3.0-or-later
// The journal of a run: one line of JSON an event, each handed to the system in one piece as it
// happens, so that a run that is killed loses nothing it had recorded. A line is
// {"n":<number from 1>,"event":<name>, <fields>}. It carries no dates: equal runs write equal lines;
// what differs from run to run (seconds) belongs in a field named "unhashed". A journal that is resumed is
// repeated up to where it ended, each line compared with the one that stands there, and then goes on.
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

// How many lines a journal has, and the digest of them without what is unhashed.
struct JournalFacts {
  std::int64_t lines = 0;
  std::string digest;
  bool operator==(const JournalFacts&) const = default;
};
JournalFacts facts_of(const std::vector<Json>& lines);

// Thread-safe.
class Journal {
 public:
  // Keeps nothing but the count.
  Journal() = default;
  // Makes the file. Throws Error{bad_file} if it cannot or the file exists already.
  explicit Journal(std::filesystem::path path);
  // Takes up the journal of a run that was cut off: a torn last line, everything from a hole that a power cut
  // left on, and an event "end" are cut off it, and every write is compared with the line recorded in its
  // place until these are used up. Throws Error{bad_file} if it cannot be read or written, is a link, or is
  // damaged before its end.
  static std::unique_ptr<Journal> again(std::filesystem::path path);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  // Returns the number of the line. `fields` is an object or null. Throws Error{bad_file} when the
  // disk refuses (the file then ends with the line before), Error{bad_state} after close() and where the line
  // recorded in its place is another step.
  std::int64_t write(std::string_view event, const Json& fields = {});

  // Shows each line to `watcher` once it is kept, in order. Set before others write.
  void watch(std::function<void(std::string_view event, const Json& fields)> watcher) {
    watcher_ = std::move(watcher);
  }

  // Lines written.
  std::int64_t count() const;
  // Whether recorded lines are still ahead.
  bool repeating() const;
  // Where and how it left what was recorded, as a sentence; "" where it did not.
  std::string departure() const;
  const std::filesystem::path& path() const { return path_; }
  // Whether its file was removed, or another one put in its place, while it was written.
  bool is_lost() const;
  // Whether its file, once closed, holds other lines than were written.
  bool is_altered() const;
  // Of a journal that is closed; none before, of one without a file, and while a writer is stuck in the disk.
  std::optional<JournalFacts> facts() const;

  // Writes a last line and refuses all later ones. Waits at most `patience` for a writer that is
  // stuck in the disk; returns false, with every earlier line whole, if that was not enough.
  bool close(std::string_view event, const Json& fields, std::chrono::milliseconds patience);

 private:
  std::int64_t append(std::string_view event, const Json& fields);
  bool repeats(const Json& line);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::int64_t count_ = 0;
  bool closed_ = false;
  std::vector<Json> recorded_;      // of a resumed journal, without what is unhashed
  std::vector<std::int64_t> ends_;  // byte after each
  std::string departure_;
  Digester digester_;
  std::function<void(std::string_view, const Json&)> watcher_;
  mutable std::mutex mutex_;
};

// The lines of a journal, without what is unhashed, and how many bytes they take. `may_be_torn`: what follows
// the last newline, or a line that holds zeros, is left out. Throws Error{bad_file} for a line that is no
// JSON or does not carry its number.
struct JournalLines {
  std::vector<Json> lines;
  std::vector<std::int64_t> ends;  // byte after each
};
JournalLines read_journal(const std::filesystem::path& path, bool may_be_torn);

// A record without its member "unhashed".
Json without_unhashed(const Json& record);

// The members, however deep, in which two records differ; null where one has none: at least one, of an
// empty path where they are not both objects or differ in order alone.
struct DifferingMember {
  std::string path;  // "row.area"
  const Json *one, *other;
};
std::vector<DifferingMember> differing_members(const Json* one, const Json* other,
                                               const std::string& path = {});
// As JSON, cut after 120 bytes; "nothing" for null.
std::string brief(const Json* value);

}  // namespace asperity
