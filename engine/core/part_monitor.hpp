// SPDX-License-Identifier: GPL-3.0-or-later
// The monitor of one part of longer work: what the part reports of itself, from 0 to 1 and perhaps several
// times over (a solve has stages), becomes the share of the whole that is done, which never falls. The
// whole keeps its clock from part to part, so that the time left is that of the whole.
#pragma once

#include <chrono>
#include <string>

#include "engine/core/monitor.hpp"

namespace asperity {

class PartMonitor final : public Monitor {
 public:
  using Clock = std::chrono::steady_clock;

  // A part called `part` that takes the whole from `before` to `after`, both in [0, 1]; the whole, called
  // `whole`, has been going on since `begun`. `outer` must outlive it.
  PartMonitor(Monitor& outer, std::string whole, std::string part, double before, double after,
              Clock::time_point begun);

  // Reports that the part is about to begin.
  void begin() { report(0); }
  void progress(std::string_view what, double done) override;
  void warn(std::string_view sentence) override { outer_.warn(sentence); }
  void inform(std::string_view sentence) override { outer_.inform(sentence); }
  ResultStore* results() override { return results_; }
  // For parts that are timed: no stored result is used.
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
