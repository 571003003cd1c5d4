// SPDX-License-Identifier: GPL-3.0-or-later
// A thread for each connection, created on demand, reused for a while, and bounded in number. At the limit,
// the connection that has waited longest for its client's request is shut down.
#pragma once

#include <httplib.h>

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <thread>

namespace asperity::web {

// Thread-safe.
class Connections {
 public:
  // A connection that waits for its client and may be shut down.
  class Waiting {
   public:
    Waiting(Connections& connections, int socket);
    ~Waiting() { end(); }
    void end();
    Waiting(const Waiting&) = delete;
    Waiting& operator=(const Waiting&) = delete;

   private:
    Connections& connections_;
    std::uint64_t number_;
  };

  // Shuts down the connection with the longest wait; false if none waits.
  bool make_room();
  void shut_down_all();

 private:
  std::mutex mutex_;
  std::uint64_t last_ = 0;
  std::map<std::uint64_t, int> waiting_;  // oldest first
};

class ConnectionThreads final : public httplib::TaskQueue {
 public:
  ConnectionThreads(std::size_t most, Connections& connections) : most_(most), connections_(connections) {}
  void enqueue(std::function<void()> serve) override;
  void shutdown() override;

 private:
  void work();

  const std::size_t most_;
  Connections& connections_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<std::function<void()>> queue_;
  std::size_t threads_ = 0, idle_ = 0;
  bool over_ = false;
};

}  // namespace asperity::web
