// SPDX-License-Identifier: GPL-3.0-or-later
// The runs of a server session: current, waiting (turns.hpp), and ended.
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "bindings/web/runs/page_run.hpp"
#include "bindings/web/runs/turns.hpp"

namespace asperity::web {

struct QueueSetup {
  std::filesystem::path folder;  // parent of <id>
  RunLimits limits;
  int at_once = 2;                                         // concurrent runs
  bool shared = false;                                     // by several people
  std::size_t most_waiting = 500;                          // in all
  std::size_t most_waiting_of_one = 500;                   // of one person
  std::size_t most_kept = 5000;                            // runs of the session
  std::int64_t most_bytes_of_one = std::int64_t{8} << 30;  // on disk
  std::vector<std::string> barriers;                       // effective in the trial
};

// Thread-safe.
class RunQueue {
 public:
  explicit RunQueue(QueueSetup setup);
  ~RunQueue();

  // Throws Error{bad_state} naming the exhausted limit; Error{bad_file}.
  std::shared_ptr<PageRun> add(std::size_t owner, RunRequest request);
  // A run of any person, or null.
  std::shared_ptr<PageRun> find(const std::string& id) const;
  std::vector<std::shared_ptr<PageRun>> all() const;
  void stop(PageRun& run);

  // Ends all runs; waits for their records.
  void close();

 private:
  void work();
  // The functions below need the lock.
  std::vector<std::size_t> people_waiting() const;
  std::shared_ptr<PageRun> next();
  // On disk, plus the allowance of current runs.
  std::int64_t kept_by(std::size_t owner) const;
  void tell_places();

  const QueueSetup setup_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, std::shared_ptr<PageRun>> runs_;
  std::map<std::size_t, std::deque<std::shared_ptr<PageRun>>> waiting_;
  std::map<std::string, std::int64_t> granted_;  // bytes for current runs
  Turns turns_;
  std::size_t waiting_in_all_ = 0;
  std::int64_t last_id_ = 0;
  bool over_ = false;
  std::vector<std::thread> workers_;
};

}  // namespace asperity::web
