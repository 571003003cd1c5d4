// SPDX-License-Identifier: GPL-3.0-or-later
// What it costs to halve a part of a budget, and the cheapest way to an interval. Times of other grids follow
// from those measured, as a power of the cells; the error of the cells falls with their order, that of the
// mean with the root of the replicates.
#pragma once

#include "engine/study/budget.hpp"

namespace asperity {

// Fills what halving takes, how wide the interval is then, and the plan. `order` is that of the error of the
// cells; `solver_seconds` is how much longer a run on the coarsest grid takes to the tightest tolerance than
// to the one before.
void add_costs(Budget& budget, double order, double solver_seconds);

}  // namespace asperity
