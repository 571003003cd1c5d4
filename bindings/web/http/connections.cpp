// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/http/connections.hpp"

#include <sys/socket.h>

#include <chrono>
#include <system_error>
#include <utility>

namespace asperity::web {

Connections::Waiting::Waiting(Connections& connections, int socket) : connections_(connections) {
  const std::lock_guard lock(connections_.mutex_);
  number_ = ++connections_.last_;
  connections_.waiting_.emplace(number_, socket);
}

void Connections::Waiting::end() {
  const std::lock_guard lock(connections_.mutex_);
  connections_.waiting_.erase(number_);
}

bool Connections::make_room() {
  const std::lock_guard lock(mutex_);
  if (waiting_.empty()) return false;
  // The connection's thread leaves the list before closing the socket.
  ::shutdown(waiting_.begin()->second, SHUT_RDWR);
  waiting_.erase(waiting_.begin());
  return true;
}

void Connections::shut_down_all() {
  const std::lock_guard lock(mutex_);
  for (const auto& [number, socket] : waiting_) ::shutdown(socket, SHUT_RDWR);
}

void ConnectionThreads::enqueue(std::function<void()> serve) {
  const std::lock_guard lock(mutex_);
  queue_.push_back(std::move(serve));
  if (queue_.size() <= idle_) {
    changed_.notify_one();
    return;
  }
  if (threads_ < most_) {
    try {
      std::thread([this] { work(); }).detach();
      ++threads_;
      return;
    } catch (const std::system_error&) {
      // No more threads: as at the limit.
    }
  }
  connections_.make_room();
}

void ConnectionThreads::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    ++idle_;
    const bool woken =
        changed_.wait_for(lock, std::chrono::seconds(30), [&] { return over_ || !queue_.empty(); });
    --idle_;
    if (queue_.empty() && (over_ || !woken)) break;
    const std::function<void()> serve = std::move(queue_.front());
    queue_.pop_front();
    lock.unlock();
    serve();
    lock.lock();
  }
  --threads_;
  changed_.notify_all();
}

void ConnectionThreads::shutdown() {
  std::unique_lock lock(mutex_);
  over_ = true;
  changed_.notify_all();
  connections_.shut_down_all();
  changed_.wait(lock, [&] { return threads_ == 0; });
}

}  // namespace asperity::web
