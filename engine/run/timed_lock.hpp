// SPDX-License-Identifier: GPL-3.0-or-later
// A mutex lock with a time limit.
#pragma once

#include <chrono>
#include <mutex>
#include <thread>

namespace asperity {

// Polls every millisecond: the thread sanitizer of g++ 12 does not see the timed wait of std::timed_mutex and
// reports each later unlock.
inline std::unique_lock<std::mutex> lock_within(std::mutex& mutex, std::chrono::milliseconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  std::unique_lock lock(mutex, std::try_to_lock);
  while (!lock.owns_lock() && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    lock.try_lock();
  }
  return lock;
}

}  // namespace asperity
