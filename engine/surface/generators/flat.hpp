// SPDX-License-Identifier: GPL-3.0-or-later
// Height 0 at every node.
#pragma once

#include "engine/core/monitor.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

struct FlatOptions {
  Grid grid;
};

// Periodic. O(nodes). Throws Error{bad_value} naming `cells` or `size`.
Surface flat_surface(const FlatOptions& options, Monitor& monitor = Monitor::silent());

}  // namespace asperity
