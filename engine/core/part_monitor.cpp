// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/part_monitor.hpp"

#include <algorithm>
#include <utility>

namespace asperity {

PartMonitor::PartMonitor(Monitor& outer, std::string whole, std::string part, double before, double after,
                         Clock::time_point begun)
    : outer_(outer),
      whole_(std::move(whole)),
      part_(std::move(part)),
      before_(before),
      after_(after),
      begun_(begun),
      results_(outer.results()) {}

void PartMonitor::progress(std::string_view, double done) { report(done); }

void PartMonitor::report(double done) {
  furthest_ = std::max(furthest_, std::min(done, 1.0));
  const double seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
  outer_.progress_of_parts(whole_, before_ + furthest_ * (after_ - before_), part_, seconds);
}

}  // namespace asperity
