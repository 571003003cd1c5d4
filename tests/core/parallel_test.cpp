// SPDX-License-Identifier: GPL-3.0-or-later
// Parallel loops: every block once, lowest error, stops, counters.
#include "engine/core/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "engine/core/cost.hpp"
#include "engine/core/error.hpp"
#include "engine/core/monitor.hpp"

namespace asperity::parallel_test {
namespace {

class Parallel : public ::testing::TestWithParam<int> {
 protected:
  void SetUp() override { set_thread_count(GetParam()); }
  void TearDown() override {
    set_thread_count(0);
    stop_flag().clear();
  }
};

TEST_P(Parallel, EveryBlockRunsOnce) {
  for (const int blocks : {0, 1, 2, 3, 1000}) {
    std::vector<std::atomic<int>> runs(static_cast<std::size_t>(blocks));
    parallel_for(blocks, [&](std::int64_t k) { ++runs[static_cast<std::size_t>(k)]; });
    for (const auto& count : runs) EXPECT_EQ(count.load(), 1);
  }
}

TEST_P(Parallel, TheLowestFailureIsRethrown) {
  for (int repeat = 0; repeat < 50; ++repeat) {
    try {
      parallel_for(100, [](std::int64_t k) {
        if (k == 3 || k == 4 || k == 5) throw std::runtime_error(std::to_string(k));
      });
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "3");
    }
  }
}

TEST_P(Parallel, AFailureStopsTheLoop) {
  std::atomic<int> runs{0};
  EXPECT_THROW(parallel_for(1000000,
                            [&](std::int64_t) {
                              ++runs;
                              throw std::runtime_error("no");
                            }),
               std::runtime_error);
  // At most one failure per thread and share.
  EXPECT_LE(runs.load(), GetParam() * GetParam());
}

TEST_P(Parallel, ALowerFailureThatComesLaterIsTheOneThatIsTold) {
  try {
    parallel_for(100, [](std::int64_t k) {
      if (k == 3) std::this_thread::sleep_for(std::chrono::milliseconds(20));
      if (k == 3 || k == 97) throw std::runtime_error(std::to_string(k));
    });
    ADD_FAILURE() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "3");
  }
}

TEST_P(Parallel, AStopIsSeenBetweenBlocks) {
  std::atomic<int> runs{0};
  try {
    parallel_for(1000000, [&](std::int64_t) {
      ++runs;
      stop_flag().raise(StopReason::interrupt);
    });
    ADD_FAILURE() << "not stopped";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::interrupted);
  }
  EXPECT_LE(runs.load(), GetParam());
}

TEST_P(Parallel, TransformsOfHelpersAreCounted) {
  const CostScope scope;
  parallel_for(40, [](std::int64_t) { cost::count_transforms(0.5); });
  EXPECT_DOUBLE_EQ(scope.so_far().transforms, 20.0);
}

TEST_P(Parallel, NestedLoopsRunOnTheirOwnThread) {
  std::atomic<int> inner{0};
  parallel_for(4, [&](std::int64_t) {
    if (GetParam() > 1) {
      EXPECT_EQ(thread_count(), 1);
    }
    parallel_for(5, [&](std::int64_t) { ++inner; });
  });
  EXPECT_EQ(inner.load(), 20);
  EXPECT_EQ(thread_count(), GetParam());
}

TEST_P(Parallel, SeveralCallersAtOnce) {
  std::atomic<std::int64_t> sum{0};
  std::atomic<int> failures{0};
  std::vector<std::thread> callers;
  for (int caller = 0; caller < 3; ++caller)
    callers.emplace_back([&] {
      for (int repeat = 0; repeat < 200; ++repeat) {
        parallel_for(17, [&](std::int64_t k) { sum += k; });
        try {
          parallel_for(17, [](std::int64_t k) {
            if (k > 4) throw std::runtime_error("no");
          });
        } catch (const std::runtime_error&) {
          ++failures;
        }
      }
    });
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(sum.load(), 3 * 200 * 136);
  EXPECT_EQ(failures.load(), 3 * 200);
}

// Long blocks wake the helpers; between loops they sleep.
TEST_P(Parallel, HelpersComeBack) {
  for (int repeat = 0; repeat < 20; ++repeat) {
    std::mutex mutex;
    std::set<std::thread::id> seen;
    std::atomic<int> waiting{0};
    parallel_for(GetParam(), [&](std::int64_t) {
      {
        const std::lock_guard lock(mutex);
        seen.insert(std::this_thread::get_id());
      }
      ++waiting;
      while (waiting.load() < GetParam()) std::this_thread::yield();
    });
    EXPECT_EQ(static_cast<int>(seen.size()), GetParam());
    if (repeat % 5 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, Parallel, ::testing::Values(1, 2, 7));

TEST(ThreadCount, DefaultsToTheMachineAndNeverToNone) {
  set_thread_count(0);
  EXPECT_GE(thread_count(), 1);
  set_thread_count(3);
  EXPECT_EQ(thread_count(), 3);
  {
    const SingleThreaded outer;
    EXPECT_EQ(thread_count(), 1);
    { const SingleThreaded inner; }
    EXPECT_EQ(thread_count(), 1);
  }
  EXPECT_EQ(thread_count(), 3);
  set_thread_count(-5);
  EXPECT_GE(thread_count(), 1);
  set_thread_count(0);
}

}  // namespace
}  // namespace asperity::parallel_test
