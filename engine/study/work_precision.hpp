// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a study of work and precision. Every setting is asked once to begin with: that run gives its
// answer, makes the plans and touches the memory it needs, and is not among the times. Then all
// settings are timed in rounds, one run each, so that a machine that slows down slows all alike.
//
// A budget is quoted first and then obeyed: the cheapest setting of each way is asked, the rest is forecast
// from it (cost_forecast.hpp), and a sentence says what the study will take and what it leaves out. The
// truth has the first call on the budget, cheap settings come before dear ones, and no run is begun
// that by its forecast would end after the budget.
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

// One call of the studied function, as it is put on record.
struct StudyRun {
  const Knobs* knobs;      // of the request, which outlives it
  const std::string* way;  // null: the truth
  int round;               // 0: the first run
  std::optional<double> value;
  double seconds;
};

// The studied function and what stands about it.
class StudyWork {
 public:
  virtual ~StudyWork() = default;
  // Before each call, outside its time.
  virtual void prepare(const Knobs& /*knobs*/) {}
  // What is timed. `monitor` shows its progress as part of the study's. Throws Error for a stop and for an
  // answer that the study refuses; a setting that fails is an answer.
  virtual StudyAnswer ask(const Knobs& knobs, Monitor& monitor) = 0;
  // Between calls, where what they left behind may be cleared away; as often as costs a hundredth.
  virtual void settle() {}
  // Calls that were made since the last record, at most ten times a second and once at the end.
  virtual void record(std::span<const StudyRun> /*runs*/) {}
};

class WorkPrecision {
 public:
  using Clock = std::function<double()>;  // seconds, never going back

  // `work` and `monitor` must outlive it. Throws Error{bad_value} for a request without a setting, two
  // ways of one name, a truth that is not finite, or fewer than one repeat.
  WorkPrecision(StudyRequest request, StudyWork& work, Monitor& monitor, Clock clock = steady_seconds);

  // Once. Throws Error when a stop was asked for, when the truth failed or does not fit the budget, and
  // whatever `work` throws; result() then holds what was measured before.
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

  // `seconds`: what it is expected to take, and then what it took.
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
  std::vector<bool> asked_;  // by row: its first run was made, or it was left out
  std::vector<StudyRun> unrecorded_;
  double begun_ = 0, now_ = 0;
  double recorded_at_ = 0, shown_at_ = 0;
  double since_settled_ = 0, settling_ = 0;
  double share_ = 0, share_after_ = 0;
  PartMonitor::Clock::time_point wall_begun_{};
};

}  // namespace asperity
