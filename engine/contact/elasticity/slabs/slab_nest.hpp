// SPDX-License-Identifier: GPL-3.0-or-later
// Contact in slabs on nested grids, as half_space/nested_descent.hpp, in cell units of the finest grid. All
// processes call together.
#pragma once

#include <limits>
#include <span>
#include <string>

#include "engine/contact/elasticity/slabs/slab_level.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

struct SlabCellProblem {
  SlabShape shape;
  std::span<const double> heights;  // of this process; (height − origin)·factor is in cell units
  double origin = 0, factor = 1;
  double highest = 0;  // of all heights
  double cap = std::numeric_limits<double>::infinity();
  double mean_pressure = 0;
  double length = 1;
  double tolerance = 1e-6;
};

struct SlabCellAnswer {
  Array<double> pressure, gap;  // of this process; K p − h without offset
  double offset = 0;
  bool from_peak = false;  // as CellAnswer::from_peak
  bool converged = false;
  int applications = 0;  // on the finest grid
  int levels = 1;
  std::string stage;
};

// Start: a nearby state in cell units, gaps without the offset; empty: nested grids.
SlabCellAnswer nested_descent_in_slabs(Team& team, const SlabCellProblem& problem,
                                       std::span<const double> start_pressure,
                                       std::span<const double> start_gap, Monitor& monitor);

// p = p̄ + (|q|/2) h; not converged if p leaves the bounds.
SlabCellAnswer full_contact_in_slabs(Team& team, const SlabCellProblem& problem, Monitor& monitor);

}  // namespace asperity
