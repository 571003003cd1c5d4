// SPDX-License-Identifier: GPL-3.0-or-later
// Helper threads sleep between loops: a loop over a small grid is shorter than a thread start. One loop uses
// the helpers; a concurrent loop runs alone. A loop never waits for a helper that has not begun. In loops of
// equal length, each thread starts with the same blocks, still in its cache, and then takes others.
#include "engine/core/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

#include "engine/core/cost.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

namespace {

std::atomic<int> threads_wanted{0};
thread_local bool single_threaded = false;

class Loop {
 public:
  Loop(std::int64_t blocks, int threads, BlockFunction block)
      : block_(block), shares_(static_cast<std::size_t>(threads)) {
    for (int t = 0; t < threads; ++t) {
      shares_[static_cast<std::size_t>(t)].next = blocks * t / threads;
      shares_[static_cast<std::size_t>(t)].end = blocks * (t + 1) / threads;
    }
  }

  // Seat 0 is the caller.
  void work(int seat) {
    const SingleThreaded nested;
    const double before = cost::transforms();
    const std::size_t own = static_cast<std::size_t>(seat) % shares_.size();
    for (std::size_t i = 0; i < shares_.size(); ++i) take(shares_[(own + i) % shares_.size()]);
    if (seat > 0) {
      const std::lock_guard lock(mutex_);
      helper_transforms_ += cost::transforms() - before;
    }
  }

  void finish() {
    cost::count_transforms(helper_transforms_);
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  struct alignas(64) Share {
    std::atomic<std::int64_t> next{0};
    std::int64_t end = 0;
  };
  // Blocks below a failed block still run: the reported failure is deterministic.
  void take(Share& share) {
    while (share.next.load(std::memory_order_relaxed) < share.end) {
      const std::int64_t k = share.next.fetch_add(1);
      if (k >= share.end || k > failed_block_.load(std::memory_order_relaxed)) break;
      try {
        stop_flag().check();
        block_(k);
      } catch (const std::exception&) {
        const std::lock_guard lock(mutex_);
        if (k < failed_block_.load()) {
          failed_block_.store(k);
          failure_ = std::current_exception();
        }
      }
    }
  }

  const BlockFunction block_;
  std::vector<Share> shares_;
  std::mutex mutex_;
  std::exception_ptr failure_;
  std::atomic<std::int64_t> failed_block_{std::numeric_limits<std::int64_t>::max()};
  double helper_transforms_ = 0;
};

// About the gap between two loops of a transform.
constexpr int turns_before_sleep = 2000;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

class Pool {
 public:
  ~Pool() {
    {
      const std::lock_guard lock(mutex_);
      closing_ = true;
      ++calls_;
    }
    wake_.notify_all();
    for (std::thread& helper : helpers_) helper.join();
  }

  // False if the helpers are in use.
  bool run(Loop& loop, int helpers) {
    const std::unique_lock taken(taken_, std::try_to_lock);
    if (!taken) return false;
    while (static_cast<int>(helpers_.size()) < helpers)
      helpers_.emplace_back([this, seat = static_cast<int>(helpers_.size()) + 1] { help(seat); });
    {
      const std::lock_guard lock(mutex_);
      loop_ = &loop;
      seats_ = helpers;
      ++calls_;
    }
    if (helpers == 1)
      wake_.notify_one();
    else
      wake_.notify_all();
    const Recall recall{*this};
    loop.work(0);
    return true;
  }

 private:
  // No helper may use the loop after its caller has left.
  struct Recall {
    Pool& pool;
    ~Recall() { pool.recall(); }
  };

  void recall() {
    {
      const std::lock_guard lock(mutex_);
      loop_ = nullptr;
    }
    for (int turn = 0; turn < turns_before_sleep && helping_.load() > 0; ++turn) pause();
    std::unique_lock lock(mutex_);
    left_.wait(lock, [this] { return helping_.load() == 0; });
  }

  void help(int seat) {
    std::int64_t seen = 0;
    for (;;) {
      for (int turn = 0; turn < turns_before_sleep && calls_.load() == seen; ++turn) pause();
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return calls_.load() != seen; });
      if (closing_) return;
      seen = calls_.load();
      if (loop_ == nullptr || seats_ == 0) continue;
      Loop& loop = *loop_;
      --seats_;
      ++helping_;
      lock.unlock();
      loop.work(seat);
      lock.lock();
      if (--helping_ == 0) left_.notify_one();
    }
  }

  std::mutex taken_;  // held by the loop that uses the helpers
  std::vector<std::thread> helpers_;
  std::mutex mutex_;  // guards the rest except atomics
  std::condition_variable wake_, left_;
  std::atomic<std::int64_t> calls_{0};
  std::atomic<int> helping_{0};
  Loop* loop_ = nullptr;
  int seats_ = 0;
  bool closing_ = false;
};

Pool& pool() {
  static Pool the_pool;
  return the_pool;
}

}  // namespace

int thread_count() {
  if (single_threaded) return 1;
  const int wanted = threads_wanted.load();
  static const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return wanted > 0 ? wanted : processors;
}

void set_thread_count(int threads) { threads_wanted.store(std::max(threads, 0)); }

SingleThreaded::SingleThreaded() : outer_(single_threaded) { single_threaded = true; }
SingleThreaded::~SingleThreaded() { single_threaded = outer_; }

void parallel_for(std::int64_t blocks, BlockFunction block) {
  const std::int64_t threads = std::min<std::int64_t>(thread_count(), blocks);
  if (threads > 1) {
    Loop loop(blocks, static_cast<int>(threads), block);
    if (pool().run(loop, static_cast<int>(threads - 1))) return loop.finish();
  }
  for (std::int64_t k = 0; k < blocks; ++k) {
    stop_flag().check();
    block(k);
  }
}

}  // namespace asperity
