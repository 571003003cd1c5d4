// SPDX-License-Identifier: GPL-3.0-or-later
// Monitor of one part of longer work. Progress of the part, possibly repeated (a solve has stages), becomes a
// non-decreasing share of the whole.
#pragma once

#include <chrono>
#include <string>

#include "engine/core/monitor.hpp"

namespace asperity {

class PartMonitor final : public Monitor {
 public:
  using Clock = std::chrono::steady_clock;

  // The part takes the whole, begun at `begun`, from `before` to `after` in [0, 1]. `outer` must outlive the
  // monitor.
  PartMonitor(Monitor& outer, std::string whole, std::string part, double before, double after,
              Clock::time_point begun);

  void begin() { report(0); }
  void progress(std::string_view what, double done) override;
  void warn(std::string_view sentence) override { outer_.warn(sentence); }
  void inform(std::string_view sentence) override { outer_.inform(sentence); }
  ResultStore* results() override { return results_; }
  // For timed parts: ignores stored results.
  void compute_afresh() { results_ = nullptr; }

 private:
  void report(double done);

  Monitor& outer_;
  std::string whole_, part_;
  double before_, after_;
  Clock::time_point begun_;
  ResultStore* results_;
  double furthest_ = 0;
};

}  // namespace asperity
