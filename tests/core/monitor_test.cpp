// SPDX-License-Identifier: GPL-3.0-or-later
// Progress, warnings and stops.
#include "engine/core/monitor.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

namespace asperity::monitor_test {
namespace {

class Recorder final : public Monitor {
 public:
  void progress(std::string_view what, double done) override {
    names.emplace_back(what);
    values.push_back(done);
  }
  void warn(std::string_view sentence) override { warnings.emplace_back(sentence); }
  std::vector<std::string> names, warnings;
  std::vector<double> values;
};

class Stop : public ::testing::Test {
 protected:
  void TearDown() override { stop_flag().clear(); }
  static std::string text_of(StopReason reason, ErrorCode code) {
    StopFlag flag;
    flag.raise(reason);
    try {
      flag.check();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code);
      return error.what();
    }
    return "passed";
  }
};

TEST_F(Stop, EachReasonHasItsError) {
  EXPECT_EQ(text_of(StopReason::interrupt, ErrorCode::interrupted), "interrupted");
  EXPECT_EQ(text_of(StopReason::time_limit, ErrorCode::time_limit), "the time limit of the run is reached");
  EXPECT_EQ(text_of(StopReason::memory_limit, ErrorCode::out_of_memory),
            "the memory limit of the run is reached");
  EXPECT_NO_THROW(StopFlag().check());
}

TEST_F(Stop, TheFirstReasonStandsUntilCleared) {
  StopFlag flag;
  flag.raise(StopReason::time_limit);
  flag.raise(StopReason::interrupt);
  EXPECT_EQ(flag.reason(), StopReason::time_limit);
  flag.clear();
  EXPECT_EQ(flag.reason(), StopReason::none);
  flag.raise(StopReason::interrupt);
  EXPECT_EQ(flag.reason(), StopReason::interrupt);
}

TEST_F(Stop, ATaskStopsAtItsNextStep) {
  Task task(Monitor::silent(), "work", 1000);
  task.advance();
  stop_flag().raise(StopReason::interrupt);
  EXPECT_THROW(task.advance(), Error);
  EXPECT_THROW(Task(Monitor::silent(), "more work", 10), Error);
}

TEST(Task, ReportsWhatIsDone) {
  Recorder recorder;
  Task task(recorder, "pressing", 4);
  task.advance();
  std::this_thread::sleep_for(std::chrono::milliseconds(120));
  task.advance();
  ASSERT_FALSE(recorder.values.empty());
  EXPECT_EQ(recorder.names.back(), "pressing");
  EXPECT_EQ(recorder.values.back(), 0.5);
  std::this_thread::sleep_for(std::chrono::milliseconds(120));
  task.advance(50);  // more than was announced
  EXPECT_EQ(recorder.values.back(), 1.0);
}

TEST(Task, ReportsAtMostTenTimesASecond) {
  Recorder recorder;
  const auto start = std::chrono::steady_clock::now();
  Task task(recorder, "stepping", 300);
  for (int k = 0; k < 300; ++k) {
    task.advance();
    std::this_thread::sleep_for(std::chrono::microseconds(500));
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_LE(static_cast<double>(recorder.values.size()), seconds * 10);
}

TEST(Task, OfNoSteps) {
  Recorder recorder;
  Task task(recorder, "nothing", 0);
  EXPECT_NO_THROW(task.advance(0));
}

TEST(Monitor, SilentTakesEverything) {
  EXPECT_NO_THROW(Monitor::silent().progress("x", 0.5));
  EXPECT_NO_THROW(Monitor::silent().warn("x"));
}

}  // namespace
}  // namespace asperity::monitor_test
