// SPDX-License-Identifier: GPL-3.0-or-later
// The contact problem on nested grids: solved roughly on the coarsest, carried up as a field whose level
// sets are the edges of contact and of the capped ground, and finished on the finest by a chain of stages,
// each starting from the feasible pressures of the one before. Cell units of the finest grid throughout its
// interface. Also the problem's light end, solved further, and full contact, an exact filter.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>

#include "engine/contact/elasticity/half_space/solver/descent.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// Progress on a logarithmic scale of the residual, and the place where a stop is seen.
class DescentProgress {
 public:
  DescentProgress(Monitor& monitor, const char* of) : task_(monitor, of, total) {}
  // A grid whose share of all work goes from `begin` to `end` has come to this residual.
  void report(double begin, double end, double residual, double tolerance);

 private:
  static constexpr std::int64_t total = 1000;
  Task task_;
  std::int64_t done_ = 0;
};

struct CellProblem {
  LevelShape shape;
  std::span<const double> heights;  // any unit; (height − origin)·factor is in cell units
  double origin = 0, factor = 1;
  // Ground that lies lower has nothing over it: it begins without pressure, and whoever states the problem
  // put it where nothing comes. In the unit of the heights, on a free tile only, whose coarser grids are
  // nodes of the finer ones.
  double lowest = -std::numeric_limits<double>::infinity();
  PressureLimit limit;
  double mean_pressure = 0;
  // Given in place of the load, of which `mean_pressure` is then a guess, within twenty powers of ten.
  std::optional<double> offset;
  ChainEffort effort = ChainEffort::full;
  double length = 1;  // what gaps are measured by
  double tolerance = 1e-6;
};

struct CellAnswer {
  UnsetArray<double> pressure;  // feasible, bounds exact
  UnsetArray<double> gap;       // K p − h, without offset, from an application to `pressure`
  double offset = 0;
  // A light contact, where h + offset is a small difference of large heights: gap and offset are counted
  // from the highest node, and the offset is the approach.
  bool from_peak = false;
  bool converged = false;
  int applications = 0;  // on the finest grid
  int levels = 1;
  bool single = false;  // steps were computed in single precision
  std::string stage;
};

// A nearby state to begin from, on nx x ny nodes of the same tile: pressures and gaps (the offset taken off)
// in the cell units of the problem; empty for none. At a given offset, where gaps are given on the problem's
// own nodes, the pressures may be outside their bounds.
struct CellStart {
  int nx = 0, ny = 0;
  std::span<const double> pressure, gap;
};

// From `start`, or on nested grids without one. Does not throw for lack of convergence.
CellAnswer nested_descent(const CellProblem& problem, const CellStart& start, Monitor& monitor);

// The answer where all of a periodic tile touches and nothing is limited, p = p̄ + (|q|/2) h; converged is
// false where that solution is not feasible. Two applications.
CellAnswer full_contact(const CellProblem& problem, Monitor& monitor);

}  // namespace asperity
