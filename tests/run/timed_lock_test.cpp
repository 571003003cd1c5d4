// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/run_folder.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <mutex>
#include <thread>

namespace asperity::timed_lock_test {
namespace {

using std::chrono::milliseconds;

TEST(PatientLockThreads, IsHadAtOnceWhenFreeEvenWithoutPatience) {
  std::mutex mutex;
  EXPECT_TRUE(lock_within(mutex, milliseconds(0)).owns_lock());
  EXPECT_TRUE(lock_within(mutex, milliseconds(0)).owns_lock()) << "the first was let go";
}

TEST(PatientLockThreads, IsGivenUpWhenHeldForLonger) {
  std::mutex mutex;
  const std::lock_guard held(mutex);
  const auto begin = std::chrono::steady_clock::now();
  const bool had =
      std::async(std::launch::async, [&] { return lock_within(mutex, milliseconds(20)).owns_lock(); }).get();
  EXPECT_FALSE(had);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, milliseconds(20));
}

TEST(PatientLockThreads, IsHadWhenLetGoInTime) {
  std::mutex mutex;
  std::promise<void> is_held;
  std::jthread holder([&] {
    const std::lock_guard held(mutex);
    is_held.set_value();
    std::this_thread::sleep_for(milliseconds(20));
  });
  is_held.get_future().wait();
  EXPECT_TRUE(lock_within(mutex, std::chrono::minutes(1)).owns_lock());
}

}  // namespace
}  // namespace asperity::timed_lock_test
