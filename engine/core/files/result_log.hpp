// SPDX-License-Identifier: GPL-3.0-or-later
// Log of small results: for thousands of cases, a file and a disk wait each would cost more than the presses.
// Each process appends to its own log and reads all logs of the folder. A record is length, digest, name and
// bytes (ByteWriter: for one build), appended in one piece: a kill loses no record; altered records are
// reported and ignored. Syncs at most once per second, and in wait_for_disk().
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

// Serial form of a result. result_from() starts after the key, and throws Error{bad_file} for other bytes.
void write_result(const std::string& key, const ResultFacts& facts, const KeptFields& fields,
                  const std::function<void(std::string_view)>& take);
std::string result_bytes(const std::string& key, const ResultFacts& facts, const KeptFields& fields);
FoundResult result_from(ByteReader& in);

// Thread-safe.
class ResultLog {
 public:
  static constexpr std::string_view folder_name = "small";  // inside the store's folder
  static constexpr std::int64_t bytes_beside = 72;
  // Exceeded by at most one record.
  static constexpr std::int64_t longest_file = std::int64_t{64} << 20;

  // `note` receives damaged files.
  using Note = std::function<void(const std::string& file, std::string sentence)>;
  ResultLog(std::filesystem::path folder, Note note) : folder_(std::move(folder)), note_(std::move(note)) {}
  ~ResultLog();

  // Finds records of all processes by name, 32 characters.
  struct Found {
    std::string bytes;
    std::filesystem::path file;
  };
  std::optional<Found> find(const std::string& name);
  // Returns the file. Throws Error{bad_file}.
  std::filesystem::path keep(const std::string& name, std::string_view bytes);
  // Throws Error{bad_file}.
  void wait_for_disk();

 private:
  struct Place {
    int file = 0;
    std::int64_t offset = 0;  // of the record
    std::int64_t length = 0;
  };
  struct File {
    std::filesystem::path path;
    std::int64_t read = 0;  // bytes read
    bool damaged = false;   // the rest is not read
    bool own = false;       // already in places_
  };

  // With the mutex held.
  void look();
  void go_through(int file);
  std::optional<std::string> record_at(const Place& place, std::string_view name);
  void begin_file();
  void leave_file();

  const std::filesystem::path folder_;
  const Note note_;
  std::mutex mutex_;  // guards the following
  std::unordered_map<std::string, Place> places_;
  std::map<std::string, int> known_;  // indices into files_
  std::vector<File> files_;
  std::filesystem::file_time_type listed_{};  // at the last listing
  bool listed_once_ = false, settled_ = false;
  int own_ = -1, descriptor_ = -1;         // the file being written
  std::int64_t written_ = 0, synced_ = 0;  // numbers of records
  bool syncing_ = false;
  std::chrono::steady_clock::time_point next_sync_{};
};

}  // namespace asperity
