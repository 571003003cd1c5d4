// SPDX-License-Identifier: GPL-3.0-or-later
// Checks the barriers of this machine: starts a confined process that tries every way out.
#pragma once

#include <string>
#include <vector>

#include "bindings/web/sandbox/confinement.hpp"

namespace asperity::web {

struct BarrierReport {
  std::vector<std::string> made, missing;  // names as in confine()
  std::vector<Barrier> tried;
  std::string problem;  // why the trial failed
  // True if every way out was tried and is closed.
  bool all_hold() const;
  // One line for each way out, then the barriers.
  std::string text() const;
};

// Takes about 10 ms. `folder`: an empty folder for the trial.
BarrierReport try_out_barriers(const std::string& folder);

}  // namespace asperity::web
