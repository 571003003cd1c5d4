// SPDX-License-Identifier: GPL-3.0-or-later
// The person with the least use is next.
#include "bindings/web/runs/turns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>
#include <thread>
#include <vector>

namespace asperity::web::turns_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Time = Turns::Clock::time_point;

const Time start{std::chrono::hours(1)};

TurnRules in_a_room(int places) {
  return {.places = places, .each = std::max(1, places - 1), .one_while_others_wait = true};
}

TEST(Turns, OneTakesAllPlacesButOne) {
  Turns turns(in_a_room(3));
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(turns.next({7}, start), 7U);
    turns.begin(7, start);
  }
  EXPECT_EQ(turns.next({7}, start), std::nullopt);
  EXPECT_EQ(turns.next({8}, start), 8U);
}

TEST(Turns, OneHoldsOnePlaceWhileOthersWait) {
  Turns turns(in_a_room(8));
  turns.begin(7, start);
  EXPECT_EQ(turns.next({7, 8}, start), 8U);
  turns.begin(8, start);
  EXPECT_EQ(turns.next({7, 8}, start), std::nullopt);
  EXPECT_EQ(turns.next({7, 8, 9}, start), 9U);
}

TEST(Turns, TheOnlyPlaceIsForEverybody) {
  Turns turns(in_a_room(1));
  EXPECT_EQ(turns.next({7}, start), 7U);
}

TEST(Turns, AloneAllPlacesAreTaken) {
  Turns turns({.places = 4, .each = 4});
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(turns.next({0}, start), 0U);
    turns.begin(0, start);
  }
}

TEST(Turns, WhoUsedLeastIsNext) {
  Turns turns(in_a_room(4));
  turns.begin(7, start);
  turns.end(7, start, 20, start + seconds(20));
  turns.begin(8, start);
  turns.end(8, start, 1, start + seconds(20));
  EXPECT_EQ(turns.next({7, 8}, start + seconds(20)), 8U);
  EXPECT_NEAR(turns.used(7, start + seconds(20)), 20, 1e-9);
  // Past use fades within minutes; running use counts at once.
  EXPECT_LT(turns.used(7, start + seconds(3000)), 0.01);
  turns.begin(8, start + seconds(3000));
  EXPECT_EQ(turns.next({7, 8}, start + seconds(3005)), 7U);
  EXPECT_GE(turns.used(8, start + seconds(3005)), 5);
}

TEST(Turns, EqualOnesTakeTurns) {
  Turns turns(in_a_room(2));
  Time now = start;
  std::size_t last = 9;
  for (int k = 0; k < 6; ++k) {
    const auto next = turns.next({7, 8}, now);
    ASSERT_TRUE(next.has_value());
    EXPECT_NE(*next, last);
    last = *next;
    turns.begin(last, now);
    turns.end(last, now, 0, now);
  }
}

TEST(Turns, LeaveSomethingForOthers) {
  Turns turns({.places = 3, .each = 2});
  auto one = turns.take(1, milliseconds(0)), two = turns.take(1, milliseconds(0));
  EXPECT_NE(one, nullptr);
  EXPECT_NE(two, nullptr);
  EXPECT_EQ(turns.take(1, milliseconds(0)), nullptr);
  const auto other = turns.take(2, milliseconds(0));
  EXPECT_NE(other, nullptr);
  EXPECT_EQ(turns.take(3, milliseconds(0)), nullptr);
  one.reset();
  EXPECT_NE(turns.take(3, milliseconds(0)), nullptr);
}

TEST(Turns, WhoHoldsLongLeavesSomeForOthers) {
  Turns turns({.places = 3, .for_quick = 2, .quick = milliseconds(5)});
  for (const std::size_t slow : {1, 2, 3}) {
    const auto held = turns.take(slow, milliseconds(0));
    ASSERT_NE(held, nullptr);
    std::this_thread::sleep_for(milliseconds(8));
  }
  auto again = turns.take(1, milliseconds(0));
  EXPECT_NE(again, nullptr);
  EXPECT_EQ(turns.take(2, milliseconds(0)), nullptr);
  auto quick = turns.take(4, milliseconds(0));
  EXPECT_NE(quick, nullptr);
  quick.reset();
  again.reset();
  EXPECT_NE(turns.take(2, milliseconds(0)), nullptr);
}

TEST(Turns, AreGivenInTheOrderOfComing) {
  Turns turns({.places = 1, .each = 9});
  auto held = turns.take(0, milliseconds(0));
  std::vector<int> order;
  std::mutex mutex;
  std::vector<std::thread> waiting;
  for (int k = 1; k <= 4; ++k) {
    waiting.emplace_back([&, k] {
      const auto share = turns.take(static_cast<std::size_t>(k), std::chrono::minutes(10));
      EXPECT_NE(share, nullptr);
      const std::lock_guard lock(mutex);
      order.push_back(k);
    });
    // A thread may start late: wait for each.
    while (turns.waiting() < static_cast<std::size_t>(k)) std::this_thread::sleep_for(milliseconds(1));
  }
  held.reset();
  for (std::thread& thread : waiting) thread.join();
  EXPECT_EQ(order, (std::vector<int>{1, 2, 3, 4}));
}

TEST(Turns, AreWaitedFor) {
  Turns turns({.places = 9});
  auto held = turns.take(1, milliseconds(0));
  std::thread later([&] {
    while (turns.waiting() == 0) std::this_thread::sleep_for(milliseconds(1));
    held.reset();
  });
  EXPECT_NE(turns.take(1, std::chrono::minutes(10)), nullptr);
  later.join();
}

}  // namespace
}  // namespace asperity::web::turns_test
