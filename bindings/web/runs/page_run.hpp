// SPDX-License-Identifier: GPL-3.0-or-later
// One run of the page: its directory, its events, and the confined process that it is while it goes on. What
// that process says is taken for what it may be, the words of a script that got loose: events of kinds that
// are known, of a bounded length, and no more bytes in all than a run may have.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings/web/confined/confined.hpp"
#include "bindings/web/http.hpp"
#include "bindings/web/runs/event_log.hpp"
#include "engine/run/run_knobs.hpp"

namespace asperity::web {

// What one run may take. Exceeding any ends it, with what it recorded.
struct RunLimits {
  double seconds = 600;                                    // on the clock
  std::int64_t memory_bytes = std::int64_t{2} << 30;       //
  std::int64_t output_bytes = std::int64_t{1} << 20;       // printed
  std::int64_t event_bytes = std::int64_t{32} << 20;       // of rows and other events
  std::int64_t directory_bytes = std::int64_t{256} << 20;  // of all its files together
  std::size_t files = 2000;                                // and folders
  int threads = 1;
};

enum class RunState { waiting, running, done, failed, stopped, limit };
const char* name(RunState state);

struct RunRequest {
  std::string script, name;
  std::int64_t seed = 1;
  bool views = false;
  GivenKnobs knobs{};
};

class PageRun {
 public:
  // Makes `folder` with the run's own directory `run` in it. Throws Error{bad_file}.
  PageRun(std::string id, std::size_t owner, RunRequest request, const std::filesystem::path& folder);

  const std::string id;
  const std::size_t owner;
  const RunRequest request;
  const std::filesystem::path folder, directory;
  EventLog events;

  RunState state() const { return state_.load(); }
  std::int64_t bytes() const { return directory_bytes_.load() + events.bytes(); }
  // Of its process and what it became, once that has ended.
  double processor_seconds() const { return processor_seconds_; }
  // Says in its events how many runs begin before it, where it waits and that is news. One call at a time.
  void tell_place(std::size_t before);
  // Ends it, soon; one that waits is over at once.
  void stop();
  bool stop_asked() const { return stop_.load(); }

  // The run from begin to end, on the thread that calls. `barriers` must stand.
  void go(const RunLimits& limits, const std::vector<std::string>& barriers);
  // Ends a run that was not begun.
  void give_up(RunState state, const std::string& reason);

 private:
  void finish(RunState state, int exit, const std::string& reason);
  void tell_files(bool last);

  std::atomic<RunState> state_{RunState::waiting};
  std::atomic<bool> stop_{false};
  std::atomic<std::int64_t> directory_bytes_{0};
  double processor_seconds_ = 0;
  std::optional<std::size_t> told_place_;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  // What is known of each file: size and time when last seen, and whether that was told.
  struct Known {
    std::int64_t bytes, changed;
    bool told;
  };
  std::map<std::string, Known> files_;

  friend class RunFollower;
};

// What a run left and leaves, as answers (run_files.cpp): its events as they come, its files, its views.
// From the query's `after` on, until the last or for some minutes: whoever asks takes it up again.
HttpResponse events_answer(const std::shared_ptr<PageRun>& run, const HttpRequest& request);
HttpResponse file_answer(const PageRun& run, const std::string& name);
HttpResponse view_answer(const PageRun& run, const std::string& name);

}  // namespace asperity::web
