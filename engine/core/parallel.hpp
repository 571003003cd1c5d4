// SPDX-License-Identifier: GPL-3.0-or-later
// Parallel loops over independent blocks, fixed by the caller: bits do not depend on the number of threads.
// The exception of the lowest failed block is rethrown.
#pragma once

#include <cstdint>
#include <functional>

namespace asperity {

// Per loop, at least 1; initially the number of processors.
int thread_count();
void set_thread_count(int threads);

// Loops of this thread use this thread only (case of an ensemble).
class SingleThreaded {
 public:
  SingleThreaded();
  ~SingleThreaded();
  SingleThreaded(const SingleThreaded&) = delete;
  SingleThreaded& operator=(const SingleThreaded&) = delete;

 private:
  bool outer_;
};

// Calls block(k), k in [0, blocks); checks the stop flag between blocks.
void parallel_for(std::int64_t blocks, const std::function<void(std::int64_t)>& block);

}  // namespace asperity
