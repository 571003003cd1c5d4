// SPDX-License-Identifier: GPL-3.0-or-later
// A run of the page: directory, events, confined process. The process counts as hostile: only known events of
// bounded length and total size.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "bindings/web/confined/confined_process.hpp"
#include "engine/core/files/json.hpp"
#include "engine/run/run_knobs.hpp"

namespace asperity::web {

// Beyond a limit the run ends; its records stay.
struct RunLimits {
  double seconds = 600;                                    // wall-clock time
  std::int64_t memory_bytes = std::int64_t{2} << 30;       //
  std::int64_t output_bytes = std::int64_t{1} << 20;       // printed
  std::int64_t event_bytes = std::int64_t{32} << 20;       // rows and other events
  std::int64_t directory_bytes = std::int64_t{256} << 20;  // all files together
  std::size_t files = 2000;                                // files and folders
  int threads = 1;
};

struct RunRequest {
  std::string script, name;
  std::int64_t seed = 1;
  bool views = false;
  GivenKnobs knobs{};
};

// The request of a run or a live script within the limits.
ConfinedRequest confined_request(Work work, const RunRequest& asked, const RunLimits& limits,
                                 const std::vector<std::string>& barriers);
// For this user only. Throws Error{bad_file}.
std::filesystem::path private_folder(const std::filesystem::path& folder);

enum class RunState { waiting, running, done, failed, stopped, limit };
const char* name(RunState state);

// The events of a run as JSON lines, numbered from 1, in a file next to the run directory, not in memory. One
// writer, many readers. Thread-safe.
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

class PageRun {
 public:
  // Creates `folder` and `folder`/run. Throws Error{bad_file}.
  PageRun(std::string id, std::size_t owner, RunRequest request, const std::filesystem::path& folder);

  const std::string id;
  const std::size_t owner;
  const RunRequest request;
  const std::filesystem::path folder, directory;
  EventLog events;

  RunState state() const { return state_.load(); }
  std::int64_t bytes() const { return directory_bytes_.load() + events.bytes(); }
  // After the end of the process.
  double processor_seconds() const { return processor_seconds_; }
  // Adds an event with the number of runs ahead, if changed. One call at a time.
  void tell_place(std::size_t before);
  // Asynchronous for a current run.
  void stop() { stop_.store(true); }
  bool stop_asked() const { return stop_.load(); }

  // The whole run, on this thread. `barriers`: required.
  void go(const RunLimits& limits, const std::vector<std::string>& barriers);
  void give_up(RunState state, const std::string& reason) { finish(state, 1, reason); }

 private:
  void finish(RunState state, int exit, const std::string& reason);
  void tell_files(bool last);

  std::atomic<RunState> state_{RunState::waiting};
  std::atomic<bool> stop_{false};
  std::atomic<std::int64_t> directory_bytes_{0};
  double processor_seconds_ = 0;
  std::optional<std::size_t> told_place_;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  struct Known {
    std::int64_t bytes, changed;
    bool told;
  };
  std::map<std::string, Known> files_;

  friend class RunFollower;
};

}  // namespace asperity::web
