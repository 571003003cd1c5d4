// SPDX-License-Identifier: GPL-3.0-or-later
// The person with the least use is next.
#include "bindings/web/runs/turns.hpp"

#include <gtest/gtest.h>

namespace asperity::web::turns_test {
namespace {

using std::chrono::seconds;
using Time = Turns::Clock::time_point;

const Time start{std::chrono::hours(1)};

TEST(Turns, OneTakesAllPlacesButOne) {
  Turns turns(3, true);
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(turns.next({7}, start), 7U);
    turns.begin(7, start);
  }
  EXPECT_EQ(turns.next({7}, start), std::nullopt);
  EXPECT_EQ(turns.next({8}, start), 8U);
}

TEST(Turns, OneHoldsOnePlaceWhileOthersWait) {
  Turns turns(8, true);
  turns.begin(7, start);
  EXPECT_EQ(turns.next({7, 8}, start), 8U);
  turns.begin(8, start);
  EXPECT_EQ(turns.next({7, 8}, start), std::nullopt);
  EXPECT_EQ(turns.next({7, 8, 9}, start), 9U);
}

TEST(Turns, TheOnlyPlaceIsForEverybody) {
  Turns turns(1, true);
  EXPECT_EQ(turns.next({7}, start), 7U);
}

TEST(Turns, AloneAllPlacesAreTaken) {
  Turns turns(4, false);
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(turns.next({0}, start), 0U);
    turns.begin(0, start);
  }
}

TEST(Turns, WhoUsedLeastIsNext) {
  Turns turns(4, true);
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
  Turns turns(2, true);
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

}  // namespace
}  // namespace asperity::web::turns_test
