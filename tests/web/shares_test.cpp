// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/runs/shares.hpp"

#include <gtest/gtest.h>

#include <mutex>
#include <thread>
#include <vector>

namespace asperity::web::shares_test {
namespace {

using std::chrono::milliseconds;

TEST(Shares, LeaveSomethingForOthers) {
  Shares shares(2, 3);
  auto one = shares.take(1, milliseconds(0)), two = shares.take(1, milliseconds(0));
  EXPECT_NE(one, nullptr);
  EXPECT_NE(two, nullptr);
  EXPECT_EQ(shares.take(1, milliseconds(0)), nullptr);
  const auto other = shares.take(2, milliseconds(0));
  EXPECT_NE(other, nullptr);
  EXPECT_EQ(shares.take(3, milliseconds(0)), nullptr);
  one.reset();
  EXPECT_NE(shares.take(3, milliseconds(0)), nullptr);
}

TEST(Shares, WhoHoldsLongLeavesSomeForOthers) {
  Shares shares(1, 3, 2, milliseconds(5));
  for (const std::size_t slow : {1, 2, 3}) {
    const auto held = shares.take(slow, milliseconds(0));
    ASSERT_NE(held, nullptr);
    std::this_thread::sleep_for(milliseconds(8));
  }
  auto again = shares.take(1, milliseconds(0));
  EXPECT_NE(again, nullptr);
  EXPECT_EQ(shares.take(2, milliseconds(0)), nullptr);
  auto quick = shares.take(4, milliseconds(0));
  EXPECT_NE(quick, nullptr);
  quick.reset();
  again.reset();
  EXPECT_NE(shares.take(2, milliseconds(0)), nullptr);
}

TEST(Shares, AreGivenInTheOrderOfComing) {
  Shares shares(9, 1);
  auto held = shares.take(0, milliseconds(0));
  std::vector<int> order;
  std::mutex mutex;
  std::vector<std::thread> waiting;
  for (int k = 1; k <= 4; ++k) {
    waiting.emplace_back([&, k] {
      const auto share = shares.take(static_cast<std::size_t>(k), std::chrono::minutes(10));
      EXPECT_NE(share, nullptr);
      const std::lock_guard lock(mutex);
      order.push_back(k);
    });
    // A thread may start late: wait for each.
    while (shares.waiting() < static_cast<std::size_t>(k)) std::this_thread::sleep_for(milliseconds(1));
  }
  held.reset();
  for (std::thread& thread : waiting) thread.join();
  EXPECT_EQ(order, (std::vector<int>{1, 2, 3, 4}));
}

TEST(Shares, AreWaitedFor) {
  Shares shares(1, 9);
  auto held = shares.take(1, milliseconds(0));
  std::thread later([&] {
    while (shares.waiting() == 0) std::this_thread::sleep_for(milliseconds(1));
    held.reset();
  });
  EXPECT_NE(shares.take(1, std::chrono::minutes(10)), nullptr);
  later.join();
}

}  // namespace
}  // namespace asperity::web::shares_test
