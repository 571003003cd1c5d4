// SPDX-License-Identifier: GPL-3.0-or-later
// A bounded number of threads, one for each connection, reused for a while. At the limit, the connection with
// the longest wait for a request is shut down.
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
  // Waits for its client; may be shut down.
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

  // False if no connection waits.
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
