// SPDX-License-Identifier: GPL-3.0-or-later
// Laws that a run meets are kept with the line of the journal, once, and only while somebody follows.
#include "engine/core/laws_met.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace asperity::laws_met_test {
namespace {

TEST(LawsMet, KeepsTheFirstLineWhileItIsFollowed) {
  LawsMet met;
  met.meet(Law::overlap);
  EXPECT_EQ(met.first_line(Law::overlap), 0);
  std::int64_t line = 3;
  met.follow([&] { return line; });
  EXPECT_EQ(met.first_line(Law::overlap), 0);
  met.meet(Law::overlap);
  line = 7;
  met.meet(Law::overlap);
  met.meet(Law::alike_readings);
  EXPECT_EQ(met.first_line(Law::overlap), 3);
  EXPECT_EQ(met.first_line(Law::alike_readings), 7);
  EXPECT_EQ(met.first_line(Law::tilt_weight), 0);
  met.follow({});
  met.meet(Law::tilt_weight);
  EXPECT_EQ(met.first_line(Law::overlap), 0);
  EXPECT_EQ(met.first_line(Law::tilt_weight), 0);
}

TEST(LawsMet, WhatIsTriedAndThrownAwayMeetsNone) {
  LawsMet met;
  met.follow([] { return 5; });
  {
    const LawsUnheard unheard;
    met.meet(Law::overlap);
    std::thread([&] { met.meet(Law::tilt_weight); }).join();
  }
  EXPECT_EQ(met.first_line(Law::overlap), 0);
  EXPECT_EQ(met.first_line(Law::tilt_weight), 5);  // another thread's work is its own
  met.meet(Law::overlap);
  EXPECT_EQ(met.first_line(Law::overlap), 5);
}

TEST(LawsMet, ThreadsMeetALawOnce) {
  LawsMet met;
  std::atomic<std::int64_t> asked{0};
  met.follow([&] { return ++asked; });
  std::vector<std::thread> threads;
  for (int k = 0; k < 8; ++k) threads.emplace_back([&] { met.meet(Law::plastic_shares); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(met.first_line(Law::plastic_shares), 1);
}

}  // namespace
}  // namespace asperity::laws_met_test
