// SPDX-License-Identifier: GPL-3.0-or-later
// Progress of the whole from its parts.
#include "engine/core/monitor.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace asperity::part_monitor_test {
namespace {

class Recorder final : public Monitor {
 public:
  void progress(std::string_view, double) override { ADD_FAILURE() << "progress of a part alone"; }
  void progress_of_parts(std::string_view what, double share, std::string_view part,
                         double whole_seconds) override {
    title = std::string(what) + "/" + std::string(part);
    done.push_back(share);
    seconds.push_back(whole_seconds);
  }
  void warn(std::string_view sentence) override { warnings.emplace_back(sentence); }
  std::string title;
  std::vector<double> done, seconds;
  std::vector<std::string> warnings;
};

TEST(PartMonitor, PartsBecomeSharesOfTheWhole) {
  Recorder recorder;
  PartMonitor part(recorder, "protocol", "event 2", 0.25, 0.75, PartMonitor::Clock::now());
  part.begin();
  part.progress("anything", 0.5);
  part.progress("anything", 1);
  EXPECT_EQ(recorder.done, (std::vector<double>{0.25, 0.5, 0.75}));
  EXPECT_EQ(recorder.title, "protocol/event 2");
}

TEST(PartMonitor, NeverFallsBack) {
  Recorder recorder;
  PartMonitor part(recorder, "w", "p", 0, 1, PartMonitor::Clock::now());
  for (const double d : {0.5, 0.1, 1.0, 0.0, 2.0}) part.progress("stage", d);
  EXPECT_EQ(recorder.done, (std::vector<double>{0.5, 0.5, 1, 1, 1}));
}

TEST(PartMonitor, ItsClockIsThatOfTheWhole) {
  Recorder recorder;
  PartMonitor part(recorder, "w", "p", 0, 1, PartMonitor::Clock::now() - std::chrono::hours(1));
  part.begin();
  EXPECT_GE(recorder.seconds.at(0), 3600);
}

TEST(PartMonitor, WarningsPassThrough) {
  Recorder recorder;
  PartMonitor(recorder, "w", "p", 0, 1, PartMonitor::Clock::now()).warn("mind the rim");
  EXPECT_EQ(recorder.warnings, std::vector<std::string>{"mind the rim"});
}

TEST(PartMonitor, PlainMonitorsSeeTheWhole) {
  class Plain final : public Monitor {
   public:
    void progress(std::string_view what, double share) override { seen = std::string(what), done = share; }
    void warn(std::string_view) override {}
    std::string seen;
    double done = -1;
  } plain;
  PartMonitor(plain, "protocol", "event 1", 0.5, 1, PartMonitor::Clock::now()).progress("solve", 0.5);
  EXPECT_EQ(plain.seen, "protocol");
  EXPECT_EQ(plain.done, 0.75);
}

}  // namespace
}  // namespace asperity::part_monitor_test
