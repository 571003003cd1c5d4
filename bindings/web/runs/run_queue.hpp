// SPDX-License-Identifier: GPL-3.0-or-later
// The runs of a session: those that go on, a few at once; those that wait, whose turn comes as turns.hpp
// says; and those that are over, whose events and files can still be read.
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
  std::filesystem::path folder;  // of the session; each run gets <folder>/<id>
  RunLimits limits;
  int at_once = 2;                                         // runs that go on together
  bool shared = false;                                     // by more than one person
  std::size_t most_waiting = 500;                          // in all
  std::size_t most_waiting_of_one = 500;                   // of one person
  std::size_t most_kept = 5000;                            // runs of the session
  std::int64_t most_bytes_of_one = std::int64_t{8} << 30;  // that the runs of one person keep on disk
  std::vector<std::string> barriers;                       // that stood when they were tried
};

// Thread-safe.
class RunQueue {
 public:
  explicit RunQueue(QueueSetup setup);
  // As close().
  ~RunQueue();
  RunQueue(const RunQueue&) = delete;
  RunQueue& operator=(const RunQueue&) = delete;

  // Throws Error{bad_state} where there is no room for it, saying of what; Error{bad_file}.
  std::shared_ptr<PageRun> add(std::size_t owner, RunRequest request);
  // Null where there is none of that person.
  std::shared_ptr<PageRun> find(std::size_t owner, const std::string& id) const;
  std::vector<std::shared_ptr<PageRun>> of(std::size_t owner) const;
  // Whoever's they are.
  std::shared_ptr<PageRun> find(const std::string& id) const;
  std::vector<std::shared_ptr<PageRun>> all() const;
  void stop(PageRun& run);

  // Ends all runs, and waits for them to make their records safe.
  void close();

 private:
  void work();
  // Below: with the lock held.
  std::vector<std::size_t> people_waiting() const;
  std::shared_ptr<PageRun> next();
  // Bytes that the runs of one person keep, or may yet write while they go on.
  std::int64_t kept_by(std::size_t owner) const;
  void tell_places();

  const QueueSetup setup_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, std::shared_ptr<PageRun>> runs_;
  std::map<std::size_t, std::deque<std::shared_ptr<PageRun>>> waiting_;
  std::map<std::string, std::int64_t> granted_;  // bytes that runs which go on may write
  Turns turns_;
  std::size_t waiting_in_all_ = 0;
  std::int64_t last_id_ = 0;
  bool over_ = false;
  std::vector<std::thread> workers_;
};

}  // namespace asperity::web
