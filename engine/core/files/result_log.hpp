// SPDX-License-Identifier: GPL-3.0-or-later
// Small results of a store, many to a file: the cases of an ensemble come by the thousand, and a file and a
// wait for the disk for each would cost more than a press. Each process appends to a log of its own,
// of a random name in a folder of the store, and reads all that are there, so that several may share the
// folder at any time. A record is its length, a digest, the name of the result and its bytes (ByteWriter: of
// one build), handed to the system in one piece: a kill loses none, and what was altered is told and never
// taken. The disk is waited for once a second at most while records come, and by wait_for_disk().
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "engine/core/files/byte_string.hpp"
#include "engine/core/files/result_store.hpp"

namespace asperity {

// A result as bytes, bit for bit, after its key; result_from() expects the key to be read already, and throws
// Error{bad_file} for what result_bytes() did not write.
std::string result_bytes(const std::string& key, const ResultFacts& facts, const KeptFields& fields);
FoundResult result_from(ByteReader& in);

// Thread-safe.
class ResultLog {
 public:
  static constexpr std::string_view folder_name = "small";  // in the folder of a store
  // Bytes that a record takes beside those of its result.
  static constexpr std::int64_t bytes_beside = 72;
  // Files of a log are no longer than this by more than a record.
  static constexpr std::int64_t longest_file = std::int64_t{64} << 20;

  // `note` is told what is damaged: the file, and a sentence. Nothing is read or made yet.
  using Note = std::function<void(const std::string& file, std::string sentence)>;
  ResultLog(std::filesystem::path folder, Note note) : folder_(std::move(folder)), note_(std::move(note)) {}
  ~ResultLog();
  ResultLog(const ResultLog&) = delete;
  ResultLog& operator=(const ResultLog&) = delete;

  // Names are of 32 characters. What others appended until now is found too. The file it was in, too.
  struct Found {
    std::string bytes;
    std::filesystem::path file;
  };
  std::optional<Found> find(const std::string& name);
  // Returns the file it is in. Throws Error{bad_file} where it cannot be written.
  std::filesystem::path keep(const std::string& name, std::string_view bytes);
  // Until the disk has all that was kept. Throws Error{bad_file}.
  void wait_for_disk();

 private:
  struct Place {
    int file = 0;
    std::int64_t offset = 0;  // of the record
    std::int64_t length = 0;
  };
  struct File {
    std::filesystem::path path;
    std::int64_t read = 0;  // bytes gone through
    bool damaged = false;   // what follows is not read
    bool own = false;       // what is in it stands in places_ already
  };

  // With the mutex held.
  void look();
  void go_through(int file);
  std::optional<std::string> record_at(const Place& place, std::string_view name);
  void begin_file();
  void leave_file();

  const std::filesystem::path folder_;
  const Note note_;
  std::mutex mutex_;  // of what follows
  std::unordered_map<std::string, Place> places_;
  std::map<std::string, int> known_;  // names of files to places in files_
  std::vector<File> files_;
  std::filesystem::file_time_type listed_{};  // the folder's time when its names were read
  bool listed_once_ = false, settled_ = false;
  int own_ = -1, descriptor_ = -1;         // the file that is written to
  std::int64_t written_ = 0, synced_ = 0;  // records
  bool syncing_ = false;
  std::chrono::steady_clock::time_point next_sync_{};
};

}  // namespace asperity
