// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings with known truth: holds, releases and turns on a jittering clock, with noise, drift, missing
// cells and overshoot.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/monitor.hpp"
#include "engine/recording/press_recording.hpp"
#include "tests/support/warnings.hpp"

namespace asperity {

struct SyntheticHold {
  double load, dwell;         // N, s
  double rise = 1, fall = 1;  // s
  double overshoot = 0;       // share of the load; straight up and down
  double rest = 20;           // s without load; 0: directly to the next hold
  double turn = 0;            // rad, during the rest
};

struct SyntheticPress {
  std::vector<SyntheticHold> holds;
  double step = 0.1, jitter = 0.5;  // s, and share of the step
  double noise = 0;                 // N
  double likeness = 0;              // correlation of neighbours; 0.9: slow filter
  double offset = 0, drift = 0;     // N, and N over the recording
  double missing = 0;               // share of missing loads
  double first_rest = 20;
};

struct SyntheticTruth {
  struct Corner {
    double time, load;
  };
  std::vector<Corner> corners;  // of the noise-free load
  struct Hold {
    double begin, end, load, steps;
  };
  std::vector<Hold> holds;
  double longest_step = 0;
};

inline PressRecording play(const SyntheticPress& press, unsigned seed, SyntheticTruth& truth) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  truth = {};
  double time = press.first_rest, load = 0;
  truth.corners = {{0, 0}, {time, 0}};
  struct Turned {
    double time, angle;
  };
  std::vector<Turned> turns;
  double angle = 0;
  const auto go = [&](double seconds, double to) {
    time += seconds;
    load = to;
    truth.corners.push_back({time, load});
  };
  for (const SyntheticHold& hold : press.holds) {
    if (hold.overshoot > 0) {
      go(hold.rise, hold.load * (1 + hold.overshoot));
      go(hold.rise, hold.load);
    } else {
      go(hold.rise, hold.load);
    }
    const double begin = time;
    go(hold.dwell, hold.load);
    truth.holds.push_back({begin, time, hold.load, 0});
    if (hold.rest > 0) {
      go(hold.fall, 0);
      if (hold.turn != 0) turns.push_back({time + 0.5 * hold.rest, angle += hold.turn});
      go(hold.rest, 0);
    }
  }
  PressRecording recording;
  recording.name = "synthetic.csv";
  const double end = time;
  std::size_t corner = 0;
  double scatter = 0;
  const double fresh = std::sqrt(1 - press.likeness * press.likeness);
  const bool turned = !turns.empty();
  std::vector<double> times;
  for (double t = 0; t < end;) {
    times.push_back(t);
    t += press.step * (1 + press.jitter * (2 * uniform(random) - 1));
  }
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double t = times[k];
    if (k > 0) truth.longest_step = std::max(truth.longest_step, t - times[k - 1]);
    while (truth.corners[corner + 1].time < t) ++corner;
    const auto& a = truth.corners[corner];
    const auto& b = truth.corners[corner + 1];
    const double clean =
        a.load + (b.load - a.load) * (b.time > a.time ? (t - a.time) / (b.time - a.time) : 0);
    scatter = press.likeness * scatter + fresh * normal(random);
    double reading = clean + press.offset + press.drift * t / end + press.noise * scatter;
    // At least five steps from a corner.
    const bool steady = a.load == b.load && t - a.time > 5 * press.step && b.time - t > 5 * press.step;
    if (steady && uniform(random) < press.missing) reading = std::numeric_limits<double>::quiet_NaN();
    recording.time.push_back(t);
    recording.load.push_back(reading);
    recording.line.push_back(static_cast<std::uint32_t>(k + 2));
    if (turned) {
      double now = 0;
      for (const Turned& turn : turns)
        if (t >= turn.time) now = turn.angle;
      recording.angle.push_back(now);
    }
  }
  return recording;
}

}  // namespace asperity
