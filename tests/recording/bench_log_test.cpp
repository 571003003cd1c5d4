// SPDX-License-Identifier: GPL-3.0-or-later
// The log of a bench reads back as performed, with its measurements.

#include <numbers>

#include "engine/core/files/source_file.hpp"
#include "engine/recording/event_detection.hpp"
#include "engine/recording/press_log.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "tests/contact/contacts.hpp"
#include "tests/recording/synthetic_recording.hpp"
#include "tests/support/run_fixture.hpp"

namespace asperity::bench_log_test {
namespace {

SpecimenPair pair() {
  return SpecimenPair(test::scene_of(test::random_surface(12, 12, 1), test::random_surface(12, 12, 2), 3.0,
                                     Boundary::periodic));
}

Protocol read_back(const SpecimenPair& pair) {
  class NoWarning final : public Monitor {
   public:
    void progress(std::string_view, double) override {}
    void warn(std::string_view sentence) override { ADD_FAILURE() << sentence; }
  } monitor;
  return read_press_log(SourceFile("done.csv", bench_log_text(pair)), monitor);
}

TEST(BenchLog, ARecordingComesBackThroughRunAndLog) {
  SyntheticPress press;
  press.noise = 0.3;
  press.offset = 2;
  press.holds = {{100, 30, 2, 2, 0, 20, 0.5 * std::numbers::pi}, {150, 20, 1, 1, 0.2}, {60, 15, 3, 3}};
  for (unsigned seed = 0; seed < 20; ++seed) {
    SyntheticTruth truth;
    const Protocol recorded = detect_events(play(press, seed, truth));
    auto bench = std::make_shared<SpecimenPair>(pair());
    ProtocolRun run(recorded, bench);
    while (!run.finished()) run.step();
    const Protocol again = read_back(*bench);
    EXPECT_EQ(again.digest(), recorded.digest()) << recorded.text() << "\n" << again.text();
  }
}

TEST(BenchLog, WhatWasDoneByHandIsThere) {
  SpecimenPair bench = pair();
  bench.press({PressBy::load, 5, 60.0});
  bench.release();
  bench.rotate(0.5 * std::numbers::pi);
  bench.press({PressBy::load, 7, {}});
  bench.place(3);
  bench.press({PressBy::load, 0, {}});
  EXPECT_EQ(read_back(bench).text(),
            "protocol of 7 events\n"
            "  1  press 5 N for 1 min (done.csv line 2)\n"
            "  2  release (done.csv line 3)\n"
            "  3  rotate 90 deg (done.csv line 3)\n"
            "  4  press 7 N (done.csv line 3)\n"
            "  5  release (done.csv line 4)\n"
            "  6  place with seed 3 (done.csv line 4)\n"
            "  7  release (done.csv line 5)");
  const std::string text = bench_log_text(bench);
  EXPECT_TRUE(
      text.starts_with("place, rotation [deg], load [N], dwell [min], result pressure [Pa], result "
                       "approach [m], result area_fraction, result peak_pressure [Pa]\n"))
      << text;
}

TEST(BenchLog, PressesAskedForInSeveralWaysStandByTheirPressure) {
  SpecimenPair bench = pair();
  const State first = bench.press({PressBy::approach, 0.2});
  bench.press({PressBy::pressure, 2.0});
  const Protocol read = read_back(bench);
  EXPECT_EQ(std::get<PressRequest>(read.events()[0].step).by, PressBy::pressure);
  EXPECT_EQ(std::get<PressRequest>(read.events()[0].step).value, first.pressure());
  EXPECT_EQ(std::get<PressRequest>(read.events()[1].step).value, 2.0);
}

TEST(BenchLog, NothingDoneIsSaidAndCopiesGoOn) {
  const SpecimenPair fresh = pair();
  EXPECT_EQ(error_of([&] { bench_log_text(fresh); }),
            "bad_state: nothing was done to this contact yet, so there is nothing to log; press it first");
  SpecimenPair bench = pair();
  bench.press({PressBy::load, 5});
  SpecimenPair other = bench.copy();
  other.release();
  EXPECT_EQ(other.history().size(), 2U);
  EXPECT_EQ(bench.history().size(), 1U);
}

TEST(BenchLog, AHundredPressesAreNotTakenForARecording) {
  std::vector<Protocol::Event> events;
  for (int k = 0; k < 120; ++k)
    events.push_back({PressRequest{PressBy::load, 5.0 + k}, static_cast<double>(k)});
  const Protocol protocol(events);
  const SourceFile log("log.csv", press_log_text(protocol));
  EXPECT_FALSE(looks_like_recording(log));
  EXPECT_EQ(read_press_log(log).digest(), protocol.digest());
}

}  // namespace
}  // namespace asperity::bench_log_test
