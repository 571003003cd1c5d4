// SPDX-License-Identifier: GPL-3.0-or-later
// Work-precision study: error against run time. Each setting first runs once untimed. Timed rounds follow
// with a run per setting: a slow machine slows all alike. With a budget, costs are forecast from the cheapest
// setting of each way; no run starts whose forecast exceeds the budget.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/monitor.hpp"
#include "engine/study/study_result.hpp"
#include "engine/study/study_setting.hpp"

namespace asperity {

// Run-time forecast of a setting. `cells` costs n² ln n (grid transforms), a factor on all cells its square,
// `tolerance` the number of digits (linear convergence). Other knobs follow a power law once two measurements
// differ only in them. No result depends on forecasts.
class CostForecast {
 public:
  void learn(std::size_t way, const Knobs& knobs, double seconds);

  // From a measurement of the same way, otherwise with the most common knobs. No way: the truth.
  // O(measurements).
  std::optional<double> seconds(std::optional<std::size_t> way, const Knobs& knobs) const;

  // From the modelled knobs alone, dimensionless.
  static double relative(const Knobs& knobs);

 private:
  struct Measured {
    std::size_t way;
    Knobs knobs;
    double seconds;
  };
  double ratio(const Knobs& knobs, const Measured& reference) const;

  std::vector<Measured> measured_;
};

struct StudyAnswer {
  std::optional<double> value;
  std::string failure;  // why there is no value
};

struct StudyRun {
  const Knobs* knobs;      // owned by the request
  const std::string* way;  // null for the truth
  int round;               // 0: untimed
  std::optional<double> value;
  double seconds;
};

class StudyWork {
 public:
  virtual ~StudyWork() = default;
  virtual void prepare(const Knobs& /*knobs*/) {}
  // A failed setting is an answer. Throws Error for a stop and for a refused answer.
  virtual StudyAnswer ask(const Knobs& knobs, Monitor& monitor) = 0;
  // Cleans up after calls; takes about 1 % of the time.
  virtual void settle() {}
  // New calls, at most ten times a second and at the end.
  virtual void record(std::span<const StudyRun> /*runs*/) {}
};

class WorkPrecision {
 public:
  using Clock = std::function<double()>;  // monotonic seconds

  // Arguments must outlive the study. Throws Error{bad_value} for no settings, no repeats, equal names or a
  // truth that is not finite.
  WorkPrecision(StudyRequest request, StudyWork& work, Monitor& monitor, Clock clock = steady_seconds);

  // Call once. Throws errors of `work`, and Error on a stop and for a truth that failed or exceeds the
  // budget. result() then has all earlier measurements.
  void run();
  const StudyResult& result() const { return result_; }

  static double steady_seconds();

 private:
  struct Quote {
    double seconds = 0;
    std::vector<const StudyRow*> left_out;
  };
  void scout();
  void ask_truth();
  void first_runs();
  void rounds();
  void finish();

  // `seconds`: forecast, then measured.
  StudyAnswer call(const Knobs& knobs, const std::string* way, int round, double& seconds);
  bool first_run(StudyRow& row);
  void leave_out(StudyRow& row, double expected, double needed);
  void flush();
  void show(const std::string& part, double expected);

  double elapsed() const { return now_ - begun_; }
  double left() const;
  double committed() const;
  std::optional<double> forecast(const StudyRow& row) const;
  std::optional<double> truth_forecast() const;
  std::vector<StudyRow*> waiting();
  Quote quote();
  std::string quote_text();

  StudyResult result_;
  StudyWork& work_;
  Monitor& monitor_;
  Clock clock_;
  CostForecast forecast_;
  std::vector<bool> asked_;  // by row: run or left out
  std::vector<StudyRun> unrecorded_;
  double begun_ = 0, now_ = 0;
  double recorded_at_ = 0, shown_at_ = 0;
  double since_settled_ = 0, settling_ = 0;
  double share_ = 0, share_after_ = 0;
  PartMonitor::Clock::time_point wall_begun_{};
};

}  // namespace asperity
