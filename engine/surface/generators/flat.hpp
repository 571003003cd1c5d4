// SPDX-License-Identifier: GPL-3.0-or-later
// A flat surface: height 0 at every node. It is the smooth counter-body that is given as a surface,
// and the base to which others are added.
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
