// SPDX-License-Identifier: GPL-3.0-or-later
// What holds a run of the page on this machine: a confined process is started that tries to get out.
#pragma once

#include <string>
#include <vector>

#include "bindings/web/sandbox/confinement.hpp"

namespace asperity::web {

struct BarrierReport {
  std::vector<std::string> made, missing;  // how confine() names them
  std::vector<Barrier> tried;
  std::string problem;  // why nothing is known
  // Whether each way out was tried and is shut.
  bool all_hold() const;
  // One line for each way out, then what it rests on.
  std::string text() const;
};

// Takes some ten milliseconds. `folder`: an empty one to try it in.
BarrierReport try_out_barriers(const std::string& folder);

}  // namespace asperity::web
