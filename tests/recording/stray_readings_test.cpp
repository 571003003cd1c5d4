// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/recording/recording_marks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "engine/recording/event_detection.hpp"
#include "engine/recording/protocol_chart.hpp"
#include "tests/recording/synthetic_recording.hpp"

namespace asperity::stray_readings_test {
namespace {

std::string kinds(const Protocol& protocol) {
  std::string all;
  for (const Protocol::Event& event : protocol.events()) all += std::string(kind(event.step)).substr(0, 2);
  return all;
}

PressRecording recorded(const std::vector<double>& loads, double step = 1) {
  PressRecording recording;
  recording.name = "press.csv";
  for (std::size_t k = 0; k < loads.size(); ++k) {
    recording.time.push_back(step * static_cast<double>(k));
    recording.load.push_back(loads[k]);
    recording.line.push_back(static_cast<std::uint32_t>(k + 2));
  }
  return recording;
}

// 20 s rise to 40 N, 80 s hold, 20 s fall, two readings per second.
std::vector<double> one_press() {
  std::vector<double> loads;
  for (int k = 0; k <= 480; ++k) {
    const double t = 0.5 * k;
    const double load = t < 20 ? 0 : t < 40 ? 2 * (t - 20) : t < 120 ? 40 : t < 140 ? 40 - 2 * (t - 120) : 0;
    loads.push_back(load + 0.05 * std::sin(37.0 * k) + 0.3);
  }
  return loads;
}

std::vector<std::string> stray_warnings(const test::Warnings& listener) {
  std::vector<std::string> found;
  for (const std::string& warning : listener.all)
    if (warning.find("stray") != std::string::npos) found.push_back(warning);
  return found;
}

// Readings from `first` on do not change one press of 40 N for 80 s.
void expect_one_press(std::size_t first, const std::vector<double>& readings) {
  std::vector<double> loads = one_press();
  std::copy(readings.begin(), readings.end(), loads.begin() + static_cast<std::ptrdiff_t>(first));
  test::Warnings listener;
  const Protocol found = detect_events(recorded(loads, 0.5), {}, listener);
  const std::string where = std::to_string(readings.size()) + " times " + std::to_string(readings[0]) +
                            " from sample " + std::to_string(first);
  ASSERT_EQ(kinds(found), "prre") << where;
  const auto& press = std::get<PressRequest>(found.events()[0].step);
  EXPECT_NEAR(press.value, 40, 0.1) << where;
  EXPECT_NEAR(*press.dwell, 80, 2) << where;
  const std::vector<std::string> told = stray_warnings(listener);
  ASSERT_EQ(told.size(), 1U) << where;
  EXPECT_NE(told[0].find(std::to_string(first + 2)), std::string::npos) << told[0];
  EXPECT_LT(protocol_chart(found, "").y.range->max, 50) << where;
}

TEST(StrayReadings, OnRampsHoldsAndRestsMakeNoPress) {
  for (const std::size_t first : {0, 10, 38, 40, 60, 79, 80, 160, 238, 240, 258, 279, 300, 478})
    for (const double reading : {9999.0, 55.0, -70.0})
      for (std::size_t count = 1; count <= 3; ++count)
        expect_one_press(first, std::vector<double>(count, reading));
  expect_one_press(60, {55, -9999, 70});
}

TEST(StrayReadings, ZerosInAHoldAreNoRelease) {
  for (std::size_t count = 1; count <= 3; ++count) {
    expect_one_press(160, std::vector<double>(count, 0));
    expect_one_press(70, std::vector<double>(count, 0));
  }
  std::vector<double> loads = one_press();
  std::fill_n(loads.begin() + 160, 4, 0.3);
  EXPECT_EQ(kinds(detect_events(recorded(loads, 0.5))), "prreprre");
}

TEST(StrayReadings, AreToldInOneLine) {
  std::vector<double> loads = one_press();
  for (const std::size_t k : {60, 160, 161, 162, 258}) loads[k] = 9999;
  test::Warnings listener;
  EXPECT_EQ(kinds(detect_events(recorded(loads, 0.5), {}, listener)), "prre");
  EXPECT_EQ(stray_warnings(listener),
            std::vector<std::string>{"\"press.csv\": 5 stray readings are left out, in lines 62, 162 to 164 "
                                     "and 260: they are off the line of the readings around"});
}

std::vector<double> operator+(std::vector<double> a, const std::vector<double>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}
std::vector<double> times(std::size_t count, double load) { return std::vector<double>(count, load); }

// No stray reading.
void expect_kept(const std::vector<double>& loads, const std::string& wanted) {
  test::Warnings listener;
  EXPECT_EQ(kinds(detect_events(recorded(loads), {}, listener)), wanted);
  EXPECT_TRUE(stray_warnings(listener).empty()) << stray_warnings(listener)[0];
}

TEST(StrayReadings, ShortPressesOfASlowLoggerAreKept) {
  const std::vector<double> rest = times(20, 0), hold = times(12, 50);
  expect_kept(rest + hold + rest + times(2, 50) + rest, "prreprre");
  expect_kept(rest + hold + rest + times(3, 60) + rest, "prreprre");
  expect_kept(rest + std::vector<double>{25} + hold + std::vector<double>{25} + rest +
                  std::vector<double>{25, 50, 25} + rest,
              "prreprre");
  expect_kept(rest + hold + rest + std::vector<double>{20, 40, 60, 40, 20} + rest, "prreprre");
  expect_kept(rest + std::vector<double>{20, 40, 60, 40, 20} + rest, "prre");
  expect_kept(
      rest + std::vector<double>{20, 40, 60, 60, 40, 20} + rest + std::vector<double>{30, 60, 60, 30} + rest,
      "prreprre");
  expect_kept(rest + times(2, 60) + rest + times(3, 50) + rest, "prreprre");
}

TEST(StrayReadings, ShortPressesAmongSlowRampsAreKept) {
  std::vector<double> slow;
  for (int k = 1; k <= 40; ++k) slow.push_back(k);
  std::vector<double> down(slow.rbegin(), slow.rend());
  const std::vector<double> rest = times(20, 0), press = slow + times(30, 40) + down;
  expect_kept(rest + press + rest + times(4, 30) + rest, "prreprre");
  expect_kept(rest + press + rest + std::vector<double>{10, 20, 30, 20, 10} + rest, "prreprre");
  expect_kept(rest + press + rest + std::vector<double>{7, 14, 21, 28, 21, 14, 7} + rest, "prreprre");
}

TEST(StrayReadings, SuddenReleasesAndOvershootsAreKept) {
  const std::vector<double> rest = times(20, 0);
  std::vector<double> rise;
  for (int k = 1; k < 40; ++k) rise.push_back(k);
  expect_kept(rest + rise + times(30, 40) + rest, "prre");
  expect_kept(rest + rise + times(30, 40) + std::vector<double>{12} + rest, "prre");
  expect_kept(rest + rise + std::vector<double>{40} + rest, "prre");
  expect_kept(rest + times(2, 60) + times(15, 50) + rest, "prprre");
  expect_kept(rest + std::vector<double>{55} + times(15, 50) + rest, "prprre");
  expect_kept(rest + times(20, 40) + times(3, 0) + times(20, 60) + rest, "prreprre");
}

// Up to ten stray readings, in runs of up to three.
class RandomRecording {
 public:
  explicit RandomRecording(unsigned seed) : random_(seed) {
    press.step = 0.05 + 0.2 * uniform();
    press.jitter = 0.6 * uniform();
    press.first_rest = 40 * press.step;
    press.offset = 20 * (2 * uniform() - 1);
    const int holds = 1 + static_cast<int>(6 * uniform());
    double last = 0, lowest = INFINITY;
    for (int k = 0; k < holds; ++k) {
      SyntheticHold hold;
      do hold.load = 100 * std::pow(10, uniform());
      while (std::abs(hold.load - last) < 0.1 * std::max(hold.load, last));
      last = hold.load;
      lowest = std::min(lowest, hold.load);
      highest_ = std::max(highest_, hold.load);
      hold.dwell = press.step * (25 + 200 * uniform());
      hold.rise = press.step * (8 + 60 * uniform() * uniform());
      hold.fall = press.step * (uniform() < 0.2 ? 0.5 : 8 + 40 * uniform() * uniform());
      hold.rest = uniform() < 0.2 && k + 1 < holds ? 0 : press.step * (25 + 80 * uniform());
      press.holds.push_back(hold);
    }
    press.noise = lowest * std::vector<double>{0, 0.001, 0.002, 0.005, 0.01}[pick(5)];
    recording = play(press, seed, truth);
    disturb();
  }

  std::string difference() const {
    test::Warnings listener;
    const Protocol found = detect_events(recording, {}, listener);
    std::string wanted;
    for (const SyntheticHold& hold : press.holds) wanted += hold.rest > 0 ? "prre" : "pr";
    if (kinds(found) != wanted) return "events " + kinds(found) + " where " + wanted + " was done";
    std::size_t event = 0;
    for (const SyntheticHold& hold : press.holds) {
      const auto& found_press = std::get<PressRequest>(found.events()[event].step);
      event += hold.rest > 0 ? 2 : 1;
      if (std::abs(found_press.value - hold.load) > 0.01 * hold.load + 2 * press.noise)
        return "a load of " + std::to_string(found_press.value) + " for " + std::to_string(hold.load);
      if (std::abs(*found_press.dwell - hold.dwell) > 12 * truth.longest_step)
        return "a dwell of " + std::to_string(*found_press.dwell) + " for " + std::to_string(hold.dwell);
    }
    if (stray_warnings(listener).size() > 1) return "more than one warning";
    return {};
  }

  SyntheticPress press;
  SyntheticTruth truth;
  PressRecording recording;

 private:
  double uniform() { return std::uniform_real_distribution<double>()(random_); }
  std::size_t pick(std::size_t n) { return static_cast<std::size_t>(static_cast<double>(n) * uniform()); }

  void disturb() {
    const std::size_t n = recording.load.size(), wanted = pick(11);
    const double far_off = std::max(0.1 * highest_, 15 * press.noise);
    std::size_t count = 0;
    std::vector<bool> taken(n + 8);
    while (count < wanted) {
      const std::size_t length = 1 + pick(std::min<std::size_t>(3, wanted - count)), first = pick(n - length);
      const std::size_t from = first - std::min(first, gap), end = first + length + gap;
      bool free = true;
      for (std::size_t k = from; k < end; ++k) free = free && !taken[k];
      if (!free) continue;
      const double stuck = value();
      const bool alike = uniform() < 0.5;
      for (std::size_t k = first; k < first + length; ++k) {
        taken[k] = true;
        double reading = alike ? stuck : value();
        while (std::abs(reading - recording.load[k]) < far_off) reading = value();
        recording.load[k] = reading;
      }
      count += length;
    }
  }
  double value() {
    const double kind = uniform(), sign = uniform() < 0.5 ? -1 : 1;
    return kind < 0.25 ? sign * 1e4 * highest_ : kind < 0.5 ? 0 : sign * highest_ * (0.5 + 3 * uniform());
  }

  static constexpr std::size_t gap = 4;  // good readings between two runs, at least
  std::mt19937_64 random_;
  double highest_ = 0;
};

TEST(StrayReadings, RandomRecordingsKeepTheirPressesAndGetNoOthers) {
  constexpr unsigned recordings = 300;
  for (unsigned seed = 1; seed <= recordings; ++seed) {
    const RandomRecording random(seed);
    EXPECT_NO_THROW(EXPECT_EQ(random.difference(), "") << "seed " << seed) << "seed " << seed;
  }
}

}  // namespace
}  // namespace asperity::stray_readings_test
