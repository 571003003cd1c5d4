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
  task.advance(50);
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

TEST(WarningKinds, AreOfOneKindWhereNumbersAloneDiffer) {
  const std::string of_a_map =
      "run.lua:7: masked: 12 of 4096 points are outliers, farther than 3.2 nm from others";
  EXPECT_EQ(
      kind_of_warning(of_a_map),
      kind_of_warning("run.lua:7: masked: 9 of 512 points are outliers, farther than 950 pm from others"));
  EXPECT_NE(
      kind_of_warning(of_a_map),
      kind_of_warning("run.lua:8: masked: 12 of 4096 points are outliers, farther than 3.2 nm from others"));
  EXPECT_NE(kind_of_warning("\"scan 1.sdf\" is short"), kind_of_warning("\"scan 2.sdf\" is short"));
  EXPECT_NE(kind_of_warning("case load = 1, seed = 1 failed"),
            kind_of_warning("case load = 1, seed = 2 failed"));
  EXPECT_EQ(kind_of_warning("at -3 um and 1e-6"), kind_of_warning("at -40 nm and 2"));
  for (const char* odd : {"", "1", "1 ", "a 1", "(1)", "\"1", "1 2 3 ", "= 1"})
    EXPECT_NO_THROW(kind_of_warning(odd));
}

TEST(WarningKinds, AreCountedAndToldOnce) {
  WarningKinds kinds;
  EXPECT_TRUE(kinds.is_first("3 of 4 are gone"));
  EXPECT_FALSE(kinds.is_first("1 of 4 are gone"));
  EXPECT_FALSE(kinds.is_first("2 of 5 are gone"));
  EXPECT_TRUE(kinds.is_first("nothing is gone"));
  EXPECT_EQ(kinds.rest(),
            (std::vector<std::string>{"2 more like this one, with other numbers: 3 of 4 are gone"}));
  EXPECT_TRUE(kinds.rest().empty());
}

}  // namespace
}  // namespace asperity::monitor_test
