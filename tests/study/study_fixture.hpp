// SPDX-License-Identifier: GPL-3.0-or-later
// A function with given answers and times and its own clock.
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "engine/core/error.hpp"
#include "engine/study/work_precision.hpp"

namespace asperity {

inline Knobs cells(std::int64_t n) { return {{"cells", n}}; }

inline StudyWay way_of_cells(const std::string& name, const std::vector<std::int64_t>& list) {
  KnobSweep sweep{"cells", {}, true};
  for (const std::int64_t n : list) sweep.values.emplace_back(n);
  return make_way(name, {sweep});
}

class WrittenWork final : public StudyWork {
 public:
  // By default: the answer 1 + 1/n, in n²/10⁶ seconds.
  std::function<StudyAnswer(const Knobs&, int call)> answer = [](const Knobs& knobs, int) {
    return StudyAnswer{1 + 1 / number_of(knobs, "cells").value_or(1), ""};
  };
  std::function<double(const Knobs&, int call)> takes = [](const Knobs& knobs, int) {
    const double n = number_of(knobs, "cells").value_or(1);
    return n * n * 1e-6;
  };

  StudyAnswer ask(const Knobs& knobs, Monitor&) override {
    const int call = static_cast<int>(asked.size());
    asked.push_back(lua_source(knobs));
    time += takes(knobs, call);
    return answer(knobs, call);
  }
  void record(std::span<const StudyRun> runs) override {
    for (const StudyRun& run : runs)
      recorded.push_back((run.way == nullptr ? "truth" : *run.way) + " " + lua_source(*run.knobs) + " " +
                         std::to_string(run.round));
  }
  WorkPrecision::Clock clock() {
    return [this] { return time; };
  }

  double time = 100;
  std::vector<std::string> asked, recorded;
};

class NotingMonitor final : public Monitor {
 public:
  void progress(std::string_view, double done) override { shares.push_back(done); }
  void warn(std::string_view) override {}
  void inform(std::string_view sentence) override { sentences.emplace_back(sentence); }
  std::vector<double> shares;
  std::vector<std::string> sentences;
};

}  // namespace asperity
