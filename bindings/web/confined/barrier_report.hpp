// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the barriers of this machine in a confined process that tries every way out.
#pragma once

#include <string>
#include <vector>

#include "bindings/web/sandbox/confinement.hpp"

namespace asperity::web {

struct BarrierReport {
  std::vector<std::string> made, missing;  // names as in confine()
  std::vector<Barrier> tried;
  std::string problem;  // why the trial failed
  bool all_hold() const;
  std::string text() const;
};

// About 10 ms. `folder`: must be empty.
BarrierReport try_out_barriers(const std::string& folder);

}  // namespace asperity::web
