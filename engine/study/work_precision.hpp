// SPDX-License-Identifier: GPL-3.0-or-later
// Work-precision study: error against run time. Each setting first runs once untimed. Timed rounds follow
// with a run per setting, so that a slow machine slows all settings alike. With a budget, costs are forecast
// from the cheapest setting of each way (cost_forecast.hpp); no run starts whose forecast exceeds the budget.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/monitor.hpp"
#include "engine/core/part_monitor.hpp"
#include "engine/study/cost_forecast.hpp"
#include "engine/study/study_result.hpp"

namespace asperity {

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
  // Timed. A failed setting is an answer. Throws Error for a stop and for a refused answer.
  virtual StudyAnswer ask(const Knobs& knobs, Monitor& monitor) = 0;
  // Cleans up between calls; takes about 1 % of the time.
  virtual void settle() {}
  // Receives new calls, at most ten times a second and once at the end.
  virtual void record(std::span<const StudyRun> /*runs*/) {}
};

class WorkPrecision {
 public:
  using Clock = std::function<double()>;  // monotonic seconds

  // Arguments must outlive the study. Throws Error{bad_value} for no settings, no repeats, equal names or a
  // truth that is not finite.
  WorkPrecision(StudyRequest request, StudyWork& work, Monitor& monitor, Clock clock = steady_seconds);

  // Call once. Throws errors of `work`, and Error on a stop and for a truth that failed or exceeds the
  // budget. result() stores all earlier measurements.
  void run();
  const StudyResult& result() const { return result_; }

  static double steady_seconds();

 private:
  struct Quote {
    double seconds = 0;
    std::vector<const StudyRow*> left_out;
  };
  void go();
  void scout();
  void ask_truth();
  void first_runs();
  void rounds();
  void finish();

  // `seconds`: forecast on entry, measured on return.
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
