// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "engine/core/cost.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

namespace {
std::atomic<int> threads_wanted{0};
thread_local bool single_threaded = false;
}  // namespace

int thread_count() {
  if (single_threaded) return 1;
  const int wanted = threads_wanted.load();
  return wanted > 0 ? wanted : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void set_thread_count(int threads) { threads_wanted.store(std::max(threads, 0)); }

SingleThreaded::SingleThreaded() : outer_(single_threaded) { single_threaded = true; }
SingleThreaded::~SingleThreaded() { single_threaded = outer_; }

void parallel_for(std::int64_t blocks, const std::function<void(std::int64_t)>& block) {
  const std::int64_t threads = std::min<std::int64_t>(thread_count(), blocks);
  if (threads <= 1) {
    for (std::int64_t k = 0; k < blocks; ++k) {
      stop_flag().check();
      block(k);
    }
    return;
  }
  std::atomic<std::int64_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  std::int64_t failed_block = blocks;
  double helper_transforms = 0;

  auto work = [&](bool helper) {
    const SingleThreaded nested;
    const double before = cost::transforms();
    for (;;) {
      const std::int64_t k = next.fetch_add(1);
      if (k >= blocks) break;
      try {
        stop_flag().check();
        block(k);
      } catch (const std::exception&) {
        const std::lock_guard lock(mutex);
        if (k < failed_block) {
          failed_block = k;
          failure = std::current_exception();
        }
        next.store(blocks);
      }
    }
    if (helper) {
      const std::lock_guard lock(mutex);
      helper_transforms += cost::transforms() - before;
    }
  };

  std::vector<std::jthread> helpers;
  helpers.reserve(static_cast<std::size_t>(threads - 1));
  for (std::int64_t t = 1; t < threads; ++t) helpers.emplace_back(work, true);
  work(false);
  for (std::jthread& helper : helpers) helper.join();
  cost::count_transforms(helper_transforms);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace asperity
