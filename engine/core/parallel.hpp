// SPDX-License-Identifier: GPL-3.0-or-later
// Loops over independent blocks on threads. The blocks are fixed by the caller, never by the number
// of threads, so results are the same bits for any number of them. An exception in a block stops
// the loop; the one of the lowest block that threw is rethrown.
#pragma once

#include <cstdint>
#include <functional>

namespace asperity {

// Threads a loop may use; at least 1. Starts as the number of processors.
int thread_count();
void set_thread_count(int threads);

// While it lives, loops of this thread run on this thread alone (a case of an ensemble).
class SingleThreaded {
 public:
  SingleThreaded();
  ~SingleThreaded();
  SingleThreaded(const SingleThreaded&) = delete;
  SingleThreaded& operator=(const SingleThreaded&) = delete;

 private:
  bool outer_;
};

// Calls block(k) once for every k in [0, blocks). Checks the stop flag between blocks.
void parallel_for(std::int64_t blocks, const std::function<void(std::int64_t)>& block);

}  // namespace asperity
