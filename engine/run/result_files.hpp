// SPDX-License-Identifier: GPL-3.0-or-later
// The results of heavy calls in a folder, one HDF5 file a result, named by its key, and those that are one of
// many in logs (core/files/result_log.hpp): what a run that was cut off has finished, and what an edited
// script shares with the last one. A file is written under a temporary name and renamed and carries a digest
// of what it holds; a torn or altered one is noticed, computed anew and replaced. Keys hold the identity of
// this build, for another build may round otherwise. Folders may be shared by runs and machines at the same
// time. Parts that killed writers left there are removed when it is opened.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <limits>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/files/result_log.hpp"
#include "engine/core/files/result_store.hpp"

namespace asperity {

struct ResultFilesSetup {
  std::filesystem::path folder;                     // made when the first result is kept
  std::vector<std::filesystem::path> also;          // looked in as well; what is found there is brought over
  std::int64_t most_bytes = std::int64_t{8} << 30;  // of the folder; what was used longest ago goes first
  // Of what this one adds: for a folder that others share, by a script of somebody else's.
  std::int64_t most_added = std::numeric_limits<std::int64_t>::max();
  double least_seconds = 0.01;                // results that cost less are not worth a file
  double least_seconds_of_many = 0.002;       // nor, of those that share one, a record
  std::string build;                          // identity of the program
  std::vector<std::filesystem::path> needed;  // without which results are of no use: on the disk before them
};

// No limit: for a folder that several runs share, which must not take away what another one needs.
inline constexpr std::int64_t unlimited = std::numeric_limits<std::int64_t>::max();

class ResultFiles final : public ResultStore {
 public:
  explicit ResultFiles(ResultFilesSetup setup);

  std::optional<FoundResult> find(const std::string& key) override;
  void keep(const std::string& key, std::string_view call, const ResultFacts& facts,
            const KeptFields& fields) override;

  struct Counts {
    std::int64_t found = 0, kept = 0;
    double seconds_saved = 0;  // what the found ones had cost
  };
  Counts counts() const;
  // Whether another file of so many bytes may be added to the folder. They are then counted.
  bool takes(std::int64_t bytes);
  // Until the disk has everything that was kept. What cannot be brought there is noticed.
  void bring_to_disk();
  // What went wrong, a sentence each: results that were damaged, or could not be kept.
  std::vector<std::string> notices() const;
  const std::filesystem::path& folder() const { return setup_.folder; }

 private:
  std::string name_of(const std::string& key) const;
  std::optional<FoundResult> read(const std::filesystem::path& file, const std::string& key);
  std::optional<FoundResult> find_in_logs(const std::string& key, const std::string& name);
  void bring_over(const std::filesystem::path& from, const std::string& name);
  void keep_in_log(const std::string& name, const std::string& bytes);
  void ready_folder();
  // Whether there is room for `bytes` more, which are then counted; noted where there is not.
  bool has_room(std::int64_t bytes);
  // Removes files until `bytes` more fit, and counts them as added; false where they never would.
  bool make_room(std::int64_t bytes);
  void note(std::string_view about, std::string sentence);

  const ResultFilesSetup setup_;
  bool needed_on_disk_ = false;
  mutable std::mutex mutex_;        // of what follows but logs, and of the folder as far as this process goes
  std::set<std::string> used_;      // by this run, as named in the folder: never removed to make room
  std::filesystem::path log_file_;  // into which the last record went
  bool ready_for_log_ = false;
  std::int64_t added_ = 0;
  std::int64_t room_ = 0, added_since_ = 0;  // when the folder was last gone through, and since
  std::vector<std::pair<std::string, std::string>> notices_;
  Counts counts_;
  ResultLog log_;
  std::deque<ResultLog> other_logs_;  // of the folders that are looked in as well
};

}  // namespace asperity
