// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/shares.hpp"

#include <gtest/gtest.h>

#include <thread>

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

TEST(Shares, AreWaitedFor) {
  Shares shares(1, 9);
  auto held = shares.take(1, milliseconds(0));
  std::thread later([&] {
    std::this_thread::sleep_for(milliseconds(20));
    held.reset();
  });
  EXPECT_NE(shares.take(1, milliseconds(10000)), nullptr);
  later.join();
}

}  // namespace
}  // namespace asperity::web::shares_test
