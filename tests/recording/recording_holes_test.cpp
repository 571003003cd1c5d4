// SPDX-License-Identifier: GPL-3.0-or-later
// Events outside absent rows are found; possible events in gaps are refused or reported; uneven sampling is
// no gap.
#include "engine/recording/recording_marks.hpp"

#include <functional>
#include <numeric>

#include "engine/recording/event_detection.hpp"
#include "tests/recording/synthetic_recording.hpp"
#include "tests/support/run_fixture.hpp"

namespace asperity::recording_holes_test {
namespace {

PressRecording recorded(const std::vector<double>& times, const std::function<double(double)>& load,
                        double noise = 0.05) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  PressRecording recording;
  recording.name = "press.csv";
  for (const double time : times) {
    recording.time.push_back(time);
    recording.load.push_back(load(time) + noise * normal(random));
    recording.line.push_back(static_cast<std::uint32_t>(recording.line.size() + 2));
  }
  return recording;
}

// Row k is on line k + 2; `count` rows or their loads are missing.
PressRecording without_rows(const PressRecording& all, std::size_t first, std::size_t count) {
  PressRecording recording;
  recording.name = all.name;
  for (std::size_t k = 0; k < all.time.size(); ++k) {
    if (k >= first && k < first + count) continue;
    recording.time.push_back(all.time[k]);
    recording.load.push_back(all.load[k]);
    recording.line.push_back(all.line[k]);
    if (!all.angle.empty()) recording.angle.push_back(all.angle[k]);
  }
  return recording;
}
PressRecording without_loads(PressRecording recording, std::size_t first, std::size_t count) {
  for (std::size_t k = first; k < first + count; ++k)
    recording.load[k] = std::numeric_limits<double>::quiet_NaN();
  return recording;
}

std::vector<double> seconds(std::size_t count) {
  std::vector<double> times(count);
  std::iota(times.begin(), times.end(), 0.0);
  return times;
}

// One sample per second: rest, `first`, `between` until 150 s, `second`, rest.
PressRecording two_levels(double first, double between, double second) {
  return recorded(seconds(260), [=](double t) {
    return t < 20 ? 0 : t < 100 ? first : t < 150 ? between : t < 220 ? second : 0;
  });
}

std::string kinds(const Protocol& protocol) {
  std::string all;
  for (const Protocol::Event& event : protocol.events()) all += std::string(kind(event.step)).substr(0, 2);
  return all;
}
std::string refusal(const PressRecording& recording) {
  return error_of([&] { detect_events(recording); });
}
double load_of(const Protocol& protocol, std::size_t event) {
  return std::get<PressRequest>(protocol.events()[event].step).value;
}

TEST(RecordingHoles, AHoldAfterAGapIsKept) {
  const Protocol found = detect_events(without_rows(two_levels(75, 0, 50), 102, 46));
  ASSERT_EQ(kinds(found), "prreprre");
  EXPECT_NEAR(load_of(found, 2), 50, 0.05);
  EXPECT_EQ(found.recording()->absent, 46U);
  EXPECT_NE(found.recording()->text().find("some 46 more absent"), std::string::npos);
}

// Every second under load, otherwise every ten: the hold counts.
TEST(RecordingHoles, AHoldBetweenLongStepsIsNeitherSwallowedNorAPeak) {
  std::vector<double> times{0};
  const auto go = [&](int count, double step) {
    for (int k = 0; k < count; ++k) times.push_back(times.back() + step);
  };
  go(12, 10);
  go(60, 1);  // from 120 s
  go(1, 10);
  go(11, 1);  // from 190 s
  go(12, 10);
  for (const double second : {50.0, 75.0, 100.0}) {
    const auto load = [=](double t) { return t < 115 ? 0 : t < 185 ? 75.0 : t < 205 ? second : 0; };
    const Protocol found = detect_events(recorded(times, load));
    if (second == 75) {
      EXPECT_EQ(kinds(found), "prre");
      continue;
    }
    ASSERT_EQ(kinds(found), "prprre");
    EXPECT_NEAR(load_of(found, 1), second, 0.05);
    std::size_t holds = 0;
    for (const RecordedSpan& span : found.recording()->spans)
      holds += span.kind == RecordedSpan::Kind::hold ? 1 : 0;
    EXPECT_EQ(holds, 2U);
  }
}

TEST(RecordingHoles, AGapBetweenTwoLevelsIsRefusedByItsLines) {
  for (const double second : {50.0, 100.0}) {
    const PressRecording whole = two_levels(75, 0, second);
    EXPECT_EQ(refusal(without_rows(whole, 90, 70)),
              "bad_file: \"press.csv\" lacks the load in the time between lines 91 and 162 while it changes, "
              "so the events there are unknown; fill the rows in by hand, or cut the "
              "recording there");
    EXPECT_NE(refusal(without_rows(whole, 90, 20)).find("between lines 91 and 112"), std::string::npos);
    EXPECT_NE(refusal(without_loads(without_rows(whole, 90, 20), 90, 5)).find("between lines 91 and 117"),
              std::string::npos);
  }
}

TEST(RecordingHoles, AGapInAHoldOrARestIsWarnedOf) {
  test::Warnings listener;
  const Protocol held = detect_events(without_rows(two_levels(75, 90, 75), 90, 70), {}, listener);
  EXPECT_EQ(kinds(held), "prre");
  EXPECT_TRUE(listener.told(
      "no load was recorded for 71 s in the time between lines 91 and 162, and is assumed constant at 75"));
  test::Warnings at_rest;
  const Protocol rested = detect_events(without_rows(two_levels(75, 0, 50), 102, 46), {}, at_rest);
  EXPECT_EQ(kinds(rested), "prreprre");
  EXPECT_TRUE(at_rest.told("no load was recorded for 47 s in the time between lines 103 and 150"));
  test::Warnings brief;
  detect_events(without_rows(two_levels(75, 0, 50), 99, 2), {}, brief);
  EXPECT_TRUE(brief.told("the load is missing while it changes, in the time between lines 100 and 103"));
}

TEST(RecordingHoles, AbsentRowsAndEmptyCellsGiveTheSameFinding) {
  const auto finding = [](const PressRecording& recording) {
    test::Warnings listener;
    std::string found;
    try {
      found = detect_events(recording, {}, listener).text();
    } catch (const Error& error) {
      found = std::string(error.what()).substr(0, std::string("\"synthetic.csv\" lacks the load in").size());
    }
    return found + ", " + std::to_string(listener.all.size()) + " warnings";
  };
  std::mt19937_64 random(41);
  std::uniform_real_distribution<double> uniform;
  int refused = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    SyntheticPress press;
    press.jitter = 0.6 * uniform(random);
    press.noise = 0.5;
    for (const double load : {100.0, 60.0, 150.0, 150.0}) {
      const double rest = uniform(random) < 0.4 ? 0 : 3 + 8 * uniform(random);
      press.holds.push_back({load, 3 + 8 * uniform(random), 0.1 + uniform(random), 0.5, 0, rest, 0});
    }
    SyntheticTruth truth;
    const PressRecording whole = play(press, seed, truth);
    const auto count = static_cast<std::size_t>(10 + 60 * uniform(random));
    const auto first = static_cast<std::size_t>(
        10 + uniform(random) * (static_cast<double>(whole.time.size() - count) - 20));
    const std::string absent = finding(without_rows(whole, first, count));
    EXPECT_EQ(absent, finding(without_loads(whole, first, count))) << "seed " << seed;
    refused += absent.find("lacks the load") != std::string::npos ? 1 : 0;
  }
  EXPECT_GT(refused, 50);
  EXPECT_LT(refused, 250);
}

// In bursts, at random, or rarely under constant load.
TEST(RecordingHoles, UnevenStepsAreNoGaps) {
  const auto load = [](double t) {
    const auto pressed = [t](double from, double to, double height) {
      return t < from || t > to + 4 ? 0.0 : height * std::min({1.0, (t - from) / 4, (to + 4 - t) / 4});
    };
    return pressed(100, 200, 50) + pressed(300, 400, 75);
  };
  const auto count_absent = [&](const std::vector<double>& times) {
    const Protocol found = detect_events(recorded(times, load));
    EXPECT_EQ(kinds(found), "prreprre");
    return found.recording()->absent;
  };
  std::vector<double> bursts, seldom;
  for (double t = 0; t < 500; t += 1)
    for (int k = 0; k < 10; ++k) bursts.push_back(t + 0.01 * k);
  EXPECT_EQ(count_absent(bursts), 0U);
  const auto changes = [&](double t) { return load(t - 0.5) != load(t + 0.5); };
  for (double t = 0; t < 500; t += changes(t) ? 0.1 : 10) seldom.push_back(t);
  EXPECT_EQ(count_absent(seldom), 0U);
  for (unsigned seed = 0; seed < 50; ++seed) {
    std::mt19937_64 random(seed);
    std::exponential_distribution<double> step(5);
    std::vector<double> times;
    for (double t = 0; t < 500; t += step(random)) times.push_back(t);
    count_absent(times);
  }
}

// Frequent gaps look like the sampling: a warning.
TEST(RecordingHoles, StepsTooUnevenToTellGapsAreWarnedOf) {
  PressRecording recording = two_levels(75, 0, 50);
  for (std::size_t first = 5; first + 21 < recording.time.size(); first += 15)
    recording = without_rows(recording, first, 6);
  test::Warnings listener;
  try {
    detect_events(recording, {}, listener);
  } catch (const Error&) {
    FAIL();
  }
  EXPECT_TRUE(listener.told("one time step in twenty is 7 s or longer, and half are 1 s or shorter"));
}

}  // namespace
}  // namespace asperity::recording_holes_test
