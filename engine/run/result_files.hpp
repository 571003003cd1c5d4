// SPDX-License-Identifier: GPL-3.0-or-later
// Results of heavy calls in a folder shared by runs and machines: one file per result, and logs
// (core/files/result_log.hpp). Files are written atomically with a digest; a damaged file is reported,
// recomputed and replaced. Keys include the build, whose rounding may differ.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <limits>
#include <list>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/core/files/result_log.hpp"
#include "engine/core/files/result_store.hpp"

namespace asperity {

struct ResultFilesSetup {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> also;          // hits here are copied to `folder`
  std::int64_t most_bytes = std::int64_t{8} << 30;  // least recently used files go
  // By this run, to a shared folder.
  std::int64_t most_added = std::numeric_limits<std::int64_t>::max();
  double least_seconds = 0.01;                // cheaper results get no file
  double least_seconds_of_many = 0.002;       // nor a log record
  std::string build;                          // identity of the program
  std::vector<std::filesystem::path> needed;  // synced before the first result
};

inline constexpr std::int64_t unlimited = std::numeric_limits<std::int64_t>::max();

class ResultFiles final : public ResultStore {
 public:
  explicit ResultFiles(ResultFilesSetup setup);

  std::optional<FoundResult> find(const std::string& key) override;
  void keep(const std::string& key, std::string_view call, const ResultFacts& facts,
            const KeptFields& fields) override;

  struct Counts {
    std::int64_t found = 0, kept = 0;
    double seconds_saved = 0;  // cost of the found results
  };
  Counts counts() const;
  // Reserves bytes for another file; false without room.
  bool takes(std::int64_t bytes);
  void bring_to_disk();
  // Results damaged or not stored.
  std::vector<std::string> notices() const;
  const std::filesystem::path& folder() const { return setup_.folder; }

 private:
  std::string name_of(const std::string& key) const;
  std::optional<FoundResult> read(const std::filesystem::path& file, const std::string& key);
  std::optional<FoundResult> find_in_logs(const std::string& key, const std::string& name);
  void bring_over(const std::filesystem::path& from, const std::string& name);
  void keep_in_log(const std::string& name, const std::string& bytes);
  void ready_folder();
  // Adds a notice if the bytes do not fit.
  bool has_room(std::int64_t bytes);
  // Removes files if needed; counts the bytes.
  bool make_room(std::int64_t bytes);
  void note(std::string_view about, std::string sentence);

  const ResultFilesSetup setup_;
  std::vector<std::filesystem::path> folders_;  // `folder` and `also`
  bool needed_on_disk_ = false;
  mutable std::mutex mutex_;        // guards all below except logs, and the folder
  std::set<std::string> used_;      // by this run; never removed
  std::filesystem::path log_file_;  // of the last record
  bool ready_for_log_ = false;
  std::int64_t added_ = 0;
  std::int64_t room_ = 0, added_since_ = 0;  // last free room; added since
  std::vector<std::pair<std::string, std::string>> notices_;
  Counts counts_;
  std::deque<ResultLog> logs_;  // of the folders
};

// Results of heavy calls for repeated runs in one process. Drops the least recently used. May precede a store
// on the disk.

// Thread-safe.
class ResultMemory final : public ResultStore {
 public:
  // 0 bytes store nothing. `behind` is searched on a miss and gets every result; it outlives the memory; may
  // be null.
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
