// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings with known truth: loads within four standard errors and dwells within two time steps, despite
// noise, drift, slow ramps, short holds and overshoot; warnings if the noise is too large.
#include "engine/recording/event_detection.hpp"

#include <filesystem>
#include <numbers>

#include "engine/core/files/source_file.hpp"
#include "engine/recording/press_recording.hpp"
#include "tests/recording/synthetic_recording.hpp"
#include "tests/support/run_fixture.hpp"

namespace asperity::event_detection_test {
namespace {

constexpr double quarter = 0.5 * std::numbers::pi;

std::string kinds(const Protocol& protocol) {
  std::string all;
  for (const Protocol::Event& event : protocol.events()) all += std::string(kind(event.step)).substr(0, 2);
  return all;
}

// The first difference from the truth, or "".
std::string difference(const SyntheticPress& press, const SyntheticTruth& truth, const Protocol& found) {
  std::string wanted;
  for (const SyntheticHold& hold : press.holds) {
    if (hold.overshoot > 0) wanted += "pr";
    wanted += "pr";
    if (hold.rest > 0) wanted += "re";
    if (hold.turn != 0) wanted += "ro";
  }
  if (kinds(found) != wanted) return "events " + kinds(found) + " where " + wanted + " was done";
  std::size_t event = 0;
  for (std::size_t k = 0; k < press.holds.size(); ++k) {
    const SyntheticHold& hold = press.holds[k];
    const auto of = [&](double value) { return std::to_string(value); };
    if (hold.overshoot > 0) {
      const double peak = std::get<PressRequest>(found.events()[event++].step).value;
      const double missed = hold.load * hold.overshoot * truth.longest_step / hold.rise;
      if (std::abs(peak - hold.load * (1 + hold.overshoot)) > missed + 6 * press.noise)
        return "a peak of " + of(peak) + " where " + of(hold.load * (1 + hold.overshoot)) + " was reached";
    }
    const auto& pressed = std::get<PressRequest>(found.events()[event].step);
    const auto& span = *std::find_if(
        found.recording()->spans.begin(), found.recording()->spans.end(), [&](const RecordedSpan& s) {
          return s.kind == RecordedSpan::Kind::hold && s.end > truth.holds[k].begin + 0.4 * hold.dwell;
        });
    // A hold begins once an overshoot is within two per cent.
    const double settling = hold.overshoot > 0 ? 1.5 * hold.rise * std::min(1.0, 0.02 / hold.overshoot) : 0;
    const double drift = std::abs(press.drift) * 0.02;
    // Samples of both ramps within the level.
    const double corners = 0.002 * hold.load;
    if (std::abs(pressed.value - hold.load) > 4 * span.load_error + drift + corners)
      return "a load of " + of(pressed.value) + " where " + of(hold.load) + " was held, to " +
             of(span.load_error);
    if (std::abs(*pressed.dwell - hold.dwell) >
        std::max(2 * truth.longest_step, 4 * span.dwell_error) + settling)
      return "a dwell of " + of(*pressed.dwell) + " where it was " + of(hold.dwell) + ", to " +
             of(span.dwell_error);
    ++event;
    if (hold.rest > 0) ++event;
    if (hold.turn != 0) {
      const double turn = std::get<Protocol::Rotate>(found.events()[event++].step).angle;
      if (std::abs(turn - hold.turn) > 1e-3) return "a turn by " + of(turn);
    }
  }
  return {};
}

SyntheticPress random_press(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform;
  SyntheticPress press;
  press.step = 0.05 + 0.2 * uniform(random);
  press.jitter = 0.9 * uniform(random);
  const int holds = 1 + static_cast<int>(8 * uniform(random));
  double last = 0;
  for (int k = 0; k < holds; ++k) {
    SyntheticHold hold;
    // Without a rest, loads within ten per cent are one hold.
    do hold.load = 100 * std::pow(10, uniform(random));
    while (std::abs(hold.load - last) < 0.1 * std::max(hold.load, last));
    last = hold.load;
    hold.dwell = press.step * (25 + 300 * uniform(random));
    hold.rise = press.step * (0.5 + 40 * uniform(random) * uniform(random));
    hold.fall = press.step * (0.5 + 20 * uniform(random) * uniform(random));
    hold.rest = uniform(random) < 0.25 && k + 1 < holds ? 0 : press.step * (25 + 100 * uniform(random));
    if (hold.rest > 0 && uniform(random) < 0.5) hold.turn = quarter * (1 + std::floor(3 * uniform(random)));
    press.holds.push_back(hold);
  }
  press.first_rest = press.step * 40;
  press.offset = 30 * (2 * uniform(random) - 1);
  return press;
}

double lowest(const SyntheticPress& press) {
  double load = press.holds.front().load;
  for (const SyntheticHold& hold : press.holds) load = std::min(load, hold.load);
  return load;
}

struct Outcome {
  std::string difference;  // "": the truth
  bool warned_of_noise = false, refused = false;
  std::string warnings;
};

Outcome outcome_of(const SyntheticPress& press, unsigned seed) {
  SyntheticTruth truth;
  const PressRecording recording = play(press, seed, truth);
  test::Warnings listener;
  Outcome outcome;
  try {
    outcome.difference = difference(press, truth, detect_events(recording, {}, listener));
  } catch (const Error& error) {
    outcome.difference = error.what();
    outcome.refused = true;
  }
  outcome.warned_of_noise = listener.told("noise hides a hold of") || listener.told(" only") ||
                            listener.told("the noise hides it") || listener.told("is not held");
  for (const std::string& warning : listener.all) outcome.warnings += "\n  " + warning;
  return outcome;
}

// Holds of at least 25 samples, ramps of up to 40, direct steps between holds, zero offsets up to 30 % of
// the lowest hold, missing cells in every third recording.
TEST(EventDetection, FindsWhatWasDone) {
  for (const double noise : {0.0, 0.001, 0.005, 0.01, 0.02, 0.05}) {
    std::mt19937_64 random(17);
    for (unsigned seed = 0; seed < 250; ++seed) {
      SyntheticPress press = random_press(random);
      press.noise = noise * lowest(press);
      press.missing = seed % 3 == 0 ? 0.05 : 0;
      const Outcome outcome = outcome_of(press, seed);
      EXPECT_EQ(outcome.difference, "") << "noise " << noise << ", seed " << seed << outcome.warnings;
    }
  }
}

// With noise up to the lowest hold: the truth or a warning.
TEST(EventDetection, SaysWhereTheNoiseIsTooMuch) {
  int wrong = 0, said = 0;
  for (const double noise : {0.1, 0.2, 0.5, 1.0, 3.0}) {
    std::mt19937_64 random(23);
    for (unsigned seed = 0; seed < 200; ++seed) {
      SyntheticPress press = random_press(random);
      for (SyntheticHold& hold : press.holds) hold.rest = std::max(hold.rest, 25 * press.step);
      press.noise = noise * lowest(press);
      const Outcome outcome = outcome_of(press, seed);
      said += outcome.warned_of_noise || outcome.refused ? 1 : 0;
      if (outcome.difference.empty()) continue;
      ++wrong;
      EXPECT_TRUE(outcome.warned_of_noise || outcome.refused)
          << "noise " << noise << ", seed " << seed << ": " << outcome.difference << outcome.warnings;
    }
  }
  EXPECT_GT(wrong, 100);
  EXPECT_GT(said, 500);
}

// Overshoot of 5 to 30 %; per hold the zero drifts by half a per cent of the highest load.
TEST(EventDetection, FindsOvershootAndFollowsTheZero) {
  for (const double noise : {0.0, 0.002, 0.005}) {
    std::mt19937_64 random(29);
    std::uniform_real_distribution<double> uniform;
    for (unsigned seed = 0; seed < 200; ++seed) {
      SyntheticPress press = random_press(random);
      double highest = 0;
      for (SyntheticHold& hold : press.holds) {
        hold.rest = std::max(hold.rest, 25 * press.step);
        hold.rise = std::max(hold.rise, 6 * press.step);
        hold.overshoot = uniform(random) < 0.5 ? 0 : 0.05 + 0.25 * uniform(random);
        highest = std::max(highest, hold.load);
      }
      press.noise = noise * lowest(press);
      press.offset *= 0.1;
      press.drift = 0.005 * highest * static_cast<double>(press.holds.size()) * (2 * uniform(random) - 1);
      const Outcome outcome = outcome_of(press, seed);
      EXPECT_EQ(outcome.difference, "") << "noise " << noise << ", seed " << seed << outcome.warnings;
    }
  }
}

// Ramps of hundreds of samples, holds of eight.
TEST(EventDetection, FindsShortHoldsOnSlowRamps) {
  for (const double noise : {0.0, 0.001, 0.01}) {
    for (unsigned seed = 0; seed < 200; ++seed) {
      SyntheticPress press;
      press.step = 0.1;
      press.noise = 100 * noise;
      for (int k = 0; k < 4; ++k)
        press.holds.push_back({100.0 + 50 * k, 0.8 + 0.3 * k, 20.0 + k, 15, 0, 10, k % 2 == 0 ? quarter : 0});
      const Outcome outcome = outcome_of(press, seed);
      if (noise > 0.005 && outcome.warned_of_noise) continue;
      EXPECT_EQ(outcome.difference, "") << "noise " << noise << ", seed " << seed << outcome.warnings;
    }
  }
}

// Sampled at 10 Hz.
SyntheticPress four_presses() {
  SyntheticPress press;
  press.step = 0.1;
  for (int k = 0; k < 4; ++k) press.holds.push_back({100.0 + 40 * k, 60, 3, 2, 0, 30, quarter});
  return press;
}

// Slow waves of filtered noise, y(k) = r y(k-1) + e, are not holds.
TEST(EventDetection, FilteredNoiseMakesNoGhosts) {
  for (const double share : {0.003, 0.01, 0.02}) {
    int exact = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
      const SyntheticPress press = four_presses();
      SyntheticTruth truth;
      PressRecording recording = play(press, seed, truth);
      std::mt19937_64 random(1000 + seed);
      std::normal_distribution<double> normal;
      constexpr double r = 0.9;
      const double deviation = share * 220;
      double noise = deviation * normal(random);
      for (double& load : recording.load) {
        noise = r * noise + std::sqrt(1 - r * r) * deviation * normal(random);
        load += noise;
      }
      test::Warnings listener;
      std::string found;
      try {
        const Protocol protocol = detect_events(recording, {}, listener);
        found = kinds(protocol);
        EXPECT_NEAR(protocol.recording()->noise, deviation, 0.35 * deviation) << share << ", seed " << seed;
      } catch (const Error& error) {
        found = error.what();
      }
      exact += found == "prreroprreroprreroprrero" ? 1 : 0;
      EXPECT_TRUE(found == "prreroprreroprreroprrero" || !listener.all.empty())
          << share << ", seed " << seed << ": " << found;
    }
    EXPECT_GE(exact, share > 0.015 ? 14 : 20) << share;
  }
}

// A sensor saturated at 50 kN in a hold of 78 kN reads a constant.
TEST(EventDetection, AClippedSensorIsNamed) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    SyntheticPress press = four_presses();
    press.noise = 0.5;
    SyntheticTruth truth;
    PressRecording recording = play(press, seed, truth);
    test::Warnings whole, clipped;
    detect_events(recording, {}, whole);
    EXPECT_FALSE(whole.told("at its limit"));
    for (double& load : recording.load) load = std::min(load, 0.5 * 220);
    detect_events(recording, {}, clipped);
    EXPECT_TRUE(clipped.told("the load stays at its greatest reading, 110 N, to the last digit in lines "));
    EXPECT_TRUE(clipped.told("the sensor may be at its limit, and the load higher"));
  }
}

// Negative compression is not a turn under load.
TEST(EventDetection, NegativeCompressionIsSaid) {
  SyntheticPress press = four_presses();
  press.noise = 0.5;
  SyntheticTruth truth;
  PressRecording recording = play(press, 1, truth);
  for (double& load : recording.load) load = -load;
  const std::string error = error_of([&] { detect_events(recording); });
  EXPECT_NE(error.find("it counts compression as negative; change the sign of its column of loads"),
            std::string::npos)
      << error;
}

// Correlated noise must not become a press unnoticed. Load errors may be underestimated, so only counts are
// checked.
TEST(EventDetection, FilteredNoiseIsNoPress) {
  for (const double noise : {0.003, 0.01, 0.02}) {
    int exact = 0;
    for (unsigned seed = 0; seed < 100; ++seed) {
      SyntheticPress press;
      press.noise = 200 * noise;
      press.likeness = 0.9;
      press.holds = {{100, 30, 2, 2, 0, 20, quarter}, {200, 20, 2, 2, 0, 20}, {60, 40, 3, 3, 0, 20, quarter}};
      const Outcome outcome = outcome_of(press, seed);
      exact += outcome.difference.empty() ? 1 : 0;
      EXPECT_TRUE(!outcome.difference.starts_with("events ") || outcome.warned_of_noise || outcome.refused)
          << "noise " << noise << ", seed " << seed << ": " << outcome.difference << outcome.warnings;
    }
    EXPECT_GE(exact, 85) << "noise " << noise;
  }
}

// One sample per second.
struct Sample {
  double load;
  double angle = 0;
};
PressRecording recorded(const std::vector<Sample>& samples) {
  PressRecording recording;
  recording.name = "press.csv";
  for (std::size_t k = 0; k < samples.size(); ++k) {
    recording.time.push_back(static_cast<double>(k));
    recording.load.push_back(samples[k].load);
    recording.angle.push_back(samples[k].angle);
    recording.line.push_back(static_cast<std::uint32_t>(k + 2));
  }
  return recording;
}
std::vector<Sample> times(std::size_t count, Sample sample) { return std::vector<Sample>(count, sample); }
std::vector<Sample> operator+(std::vector<Sample> a, const std::vector<Sample>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}
const double none = std::numeric_limits<double>::quiet_NaN();

std::string refusal(const std::vector<Sample>& samples, const DetectionOptions& options = {}) {
  return error_of([&] { detect_events(recorded(samples), options); });
}

TEST(EventDetection, AJumpIsAPressAndARelease) {
  const Protocol found = detect_events(recorded(times(20, {0}) + times(30, {50}) + times(20, {0, quarter})));
  EXPECT_EQ(found.text(),
            "protocol of 3 events\n"
            "  1  press 50 N for 29 s (at 20 s, press.csv lines 22 to 51)\n"
            "  2  release (at 49 s, press.csv lines 51 to 52)\n"
            "  3  rotate 90 deg (at 50 s, press.csv line 52)");
  ASSERT_NE(found.recording(), nullptr);
  EXPECT_EQ(found.recording()->text(),
            "recording press.csv: 70 samples, every 1 s or so\n"
            "  noise          0 N a sample, 0 % of the highest load\n"
            "  without load   0 N is read, and taken off\n"
            "  seen           holds of 4 s and more above 500 mN\n"
            "  one hold       are loads next to each other within 1 N or so\n"
            "  cut            where it saves 27 squares of the noise\n"
            "  found          1 hold, 0 peaks, 1 release, 1 turn");
  EXPECT_EQ(found.plus(found).recording(), nullptr);
}

TEST(EventDetection, ATurnUnderLoadIsRefusedByItsLine) {
  const std::string turned =
      refusal(times(20, {0}) + times(10, {50}) + times(20, {50, quarter}) + times(20, {0, quarter}));
  EXPECT_EQ(
      turned,
      "bad_file: \"press.csv\" turns under load: the angle leaves 0 deg in line 32, where it is 90 deg, "
      "while a load is on from line 22 to line 51; turn a body after its release; a larger `least_turn` "
      "ignores small turns, a larger `zero_drift` small loads");
}

TEST(EventDetection, TurnsComeInSteps) {
  const double deg = std::numbers::pi / 180;
  const auto samples =
      times(20, {0}) + times(30, {50}) + times(20, {0, 88 * deg}) + times(30, {50, 88 * deg});
  DetectionOptions options;
  options.turn_step = quarter;
  const Protocol found = detect_events(recorded(samples), options);
  EXPECT_EQ(std::get<Protocol::Rotate>(found.events()[2].step).angle, quarter);
  EXPECT_NEAR(std::get<Protocol::Rotate>(detect_events(recorded(samples)).events()[2].step).angle, 88 * deg,
              1e-9);
  options.turn_step = 60 * deg;
  EXPECT_EQ(refusal(samples, options),
            "bad_file: \"press.csv\" turns by 88 deg about line 52, which is no multiple of 60 deg; give "
            "another `turn_step`, or leave it out");
}

TEST(EventDetection, LoadsMissingInAHoldAreBridgedAndElsewhereRefused) {
  test::Warnings listener;
  const Protocol found = detect_events(
      recorded(times(20, {0}) + times(10, {50}) + times(4, {none}) + times(16, {50}) + times(20, {0})), {},
      listener);
  EXPECT_EQ(std::get<PressRequest>(found.events()[0].step).dwell, 29.0);
  EXPECT_EQ(found.recording()->missing, 4U);
  EXPECT_TRUE(listener.all.empty());
  EXPECT_EQ(refusal(times(20, {0}) + times(30, {50}) + times(10, {none}) + times(20, {0})),
            "bad_file: \"press.csv\" lacks the load in lines 52 to 61 while it changes, so the events there "
            "are unknown; fill the cells in by hand, or cut the recording there");
  detect_events(recorded(times(20, {0}) + times(30, {50}) + times(2, {none}) + times(20, {0})), {}, listener);
  EXPECT_TRUE(listener.told("the load is missing while it changes, in lines 52 to 53"));
}

TEST(EventDetection, AnAngleMissingAcrossAPressIsRefusedWhereItMatters) {
  const auto before = times(20, {0}), after = times(20, {0, quarter});
  EXPECT_TRUE(detect_events(recorded(before + times(30, {50, none}) + before)).count() == 2);
  EXPECT_TRUE(
      refusal(before + times(30, {50, none}) + after).find("the turn may be before or after the load") !=
      std::string::npos);
}

TEST(EventDetection, SaysWhatItLeavesOut) {
  test::Warnings listener;
  detect_events(recorded(times(20, {0}) + times(15, {50}) + times(1, {0}) + times(15, {50}) + times(20, {0})),
                {}, listener);
  EXPECT_TRUE(listener.told("1 stray reading is left out, in line 37: it is off the line"));
  listener.all.clear();
  detect_events(recorded(times(20, {0}) + times(15, {50})), {}, listener);
  EXPECT_TRUE(listener.told("it ends under load, in line 36"));
  listener.all.clear();
  DetectionOptions options;
  options.overshoot = DetectionOptions::Overshoot::ignore;
  const auto over = times(20, {0}) + times(2, {60}) + times(15, {50}) + times(20, {0});
  EXPECT_EQ(kinds(detect_events(recorded(over), options, listener)), "prre");
  EXPECT_TRUE(listener.told("an overshoot to 60 N in lines 22 to 23 is left out, by `overshoot`"));
  EXPECT_EQ(kinds(detect_events(recorded(over))), "prprre");
}

TEST(EventDetection, WhatHoldsNoEventIsRefused) {
  EXPECT_EQ(refusal(times(5, {1})),
            "bad_file: \"press.csv\" holds 5 samples of the load, too few to find events in; read it with "
            "events=\"rows\" if each of its rows is an event");
  EXPECT_TRUE(refusal(times(50, {0})).find("holds no load above its noise") != std::string::npos);
  EXPECT_EQ(refusal(times(20, {0}) + times(20, {1e-300})),
            "bad_file: \"press.csv\" holds extreme times or loads: 39 s in all, up to 1e-300 N; check "
            "the units of its columns");
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<Sample> noise(500);
  for (Sample& sample : noise) sample.load = normal(random);
  EXPECT_TRUE(refusal(noise).find("holds no load above its noise") != std::string::npos);
}

TEST(EventDetection, AMillionSamplesTakeNoLonger) {
  SyntheticPress press;
  press.step = 0.01;
  press.noise = 1;
  for (int k = 0; k < 20; ++k)
    press.holds.push_back({100.0 + 10 * k, 400, 5, 5, 0, 90, k % 2 == 0 ? quarter : 0});
  SyntheticTruth truth;
  const PressRecording recording = play(press, 3, truth);
  EXPECT_GT(recording.time.size(), 990'000U);
  EXPECT_EQ(difference(press, truth, detect_events(recording)), "");
}

// One extreme sample must not coarsen all loads.
TEST(EventDetection, OneSampleFarTooHighLeavesEveryPressItsLoad) {
  const std::filesystem::path file =
      std::filesystem::path(ASPERITY_TEST_DATA) / "../fuzz/corpus/press_recording/one_sample_too_high.csv";
  const Protocol found = detect_events(read_press_recording(SourceFile(file.string(), Monitor::silent())));
  int presses = 0;
  for (const Protocol::Event& event : found.events())
    if (const auto* press = std::get_if<PressRequest>(&event.step)) {
      ++presses;
      EXPECT_NEAR(press->value, 10'000, 200);
    }
  EXPECT_EQ(presses, 1);
}

}  // namespace
}  // namespace asperity::event_detection_test
