// SPDX-License-Identifier: GPL-3.0-or-later
// Parallel loops over independent blocks, fixed by the caller: bits do not depend on the number of threads.
// The exception of the lowest failed block is rethrown.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>

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

// Refers to a function, which must outlive it. std::function would instantiate ten functions for each of
// five hundred loops.
class BlockFunction {
 public:
  template <class Function>
  BlockFunction(const Function& function)
      : function_(&function),
        call_([](const void* of, std::int64_t k) { (*static_cast<const Function*>(of))(k); }) {}
  void operator()(std::int64_t k) const { call_(function_, k); }

 private:
  const void* function_;
  void (*call_)(const void* function, std::int64_t k);
};

// Calls block(k), k in [0, blocks); checks the stop flag between blocks.
void parallel_for(std::int64_t blocks, BlockFunction block);

// A value made by the first thread that needs it. After an exception, the next use tries again.
template <class T>
class Lazy {
 public:
  template <class Make>
  const T& get(const Make& make) {
    std::call_once(once_, [&] { value_.emplace(make()); });
    return *value_;
  }

 private:
  std::once_flag once_;
  std::optional<T> value_;
};

}  // namespace asperity
