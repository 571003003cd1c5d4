// SPDX-License-Identifier: GPL-3.0-or-later
// Live scripts (confined/live_script.hpp): one confined process for each tab. The process ends with its tab,
// for another script, when idle, at a limit, or to make room. Moves take turns (turns.hpp); only a tab's
// newest waiting move counts.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "bindings/web/confined/confined_process.hpp"
#include "bindings/web/runs/page_run.hpp"
#include "bindings/web/runs/turns.hpp"
#include "engine/run/run_knobs.hpp"

namespace asperity::web {

struct LiveSetup {
  std::filesystem::path folder;  // of temporary session folders
  RunLimits limits;              // seconds: of a move; else of the session
  std::vector<std::string> barriers;
  int at_once = 2;  // concurrent moves
  std::size_t most = 16;
  std::size_t most_of_one = 4;
  std::chrono::milliseconds idle = std::chrono::minutes(2);
};

// Thread-safe.
class LiveSession {
 public:
  using Clock = std::chrono::steady_clock;

  LiveSession(std::string id, std::size_t owner, std::string tab, const RunRequest& request,
              const LiveSetup& setup);
  ~LiveSession();

  const std::string id;
  const std::size_t owner;
  const std::string tab;

  // Sends a question; returns its move number. Holds `share` until the newest move is answered.
  std::int64_t move(const GivenKnobs& knobs, const std::string& view, const std::string& map,
                    std::shared_ptr<void> share);
  // The next part of a move's answer: a frame or nothing yet. False after the last.
  bool answer(std::int64_t move, std::string& piece, std::chrono::milliseconds patience);
  bool busy() const;
  bool over() const { return over_.load(); }
  void end(const std::string& why);
  Clock::time_point last_used() const;

 private:
  friend class LiveFollower;
  void work();
  void take(const std::vector<std::string>& texts);
  void finish(const std::string& why);

  ConfinedRequest request_;
  const std::filesystem::path folder_;
  const LiveSetup& setup_;
  Descriptor wake_;
  std::atomic<bool> over_{false};

  mutable std::mutex mutex_;  // guards the members below
  std::condition_variable changed_;
  std::string why_;  // reason of the end
  std::string question_;
  std::int64_t moves_ = 0, answered_ = 0;
  struct Piece {
    std::int64_t move;
    std::string frame;
    bool last;
  };
  std::deque<Piece> pieces_;
  std::shared_ptr<void> share_;
  Clock::time_point used_ = Clock::now();
  std::thread thread_;
};

// Thread-safe.
class LiveSessions {
 public:
  explicit LiveSessions(LiveSetup setup);
  ~LiveSessions();

  // Replaces the tab's session. Throws Error{bad_state} if all are busy or the server is stopping.
  std::shared_ptr<LiveSession> begin(std::size_t owner, const std::string& tab, const RunRequest& request);
  // Null if unknown or ended.
  std::shared_ptr<LiveSession> find(std::size_t owner, const std::string& id) const;
  // Waits for a turn; throws Error{bad_state} on timeout.
  std::int64_t move(LiveSession& session, const GivenKnobs& knobs, const std::string& view,
                    const std::string& map);
  void end(std::size_t owner, const std::string& id);
  void close();

 private:
  using Sessions = std::map<std::string, std::shared_ptr<LiveSession>>;
  void take_out(const std::function<bool(const LiveSession&)>& which, const std::string& why,
                std::vector<std::shared_ptr<LiveSession>>& gone);

  const LiveSetup setup_;
  Turns turns_;
  mutable std::mutex mutex_;
  Sessions sessions_;
  std::int64_t last_id_ = 0;
  bool closed_ = false;
};

}  // namespace asperity::web
