// SPDX-License-Identifier: GPL-3.0-or-later
// Nested grids, in cell units of the finest. Each coarse solution is interpolated as a field whose level
// sets are the edges of contact and of the capped area; a chain of descents finishes on the finest grid.
// Also light contacts and full contact.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "engine/contact/elasticity/half_space/solver/descent.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// Logarithmic in the residual. Throws if the user stops the run.
class DescentProgress {
 public:
  DescentProgress(Monitor& monitor, const char* of) : task_(monitor, of, total) {}
  // `begin` to `end`: the grid's share of the work.
  void report(double begin, double end, double residual, double tolerance);
  // For the next grid, of `weight` in `all` the work.
  std::function<void(double)> next_grid(double weight, double all, double tolerance);

 private:
  static constexpr std::int64_t total = 1000;
  Task task_;
  std::int64_t done_ = 0;
  double work_done_ = 0;
};

struct CellProblem {
  LevelShape shape;
  std::span<const double> heights;  // any unit; (height − origin)·factor is in cell units
  double origin = 0, factor = 1;
  // Lower nodes have no counterpart and must be out of reach. Unit of `heights`; free tile only.
  double lowest = -std::numeric_limits<double>::infinity();
  PressureLimit limit;
  double mean_pressure = 0;
  // Instead of the load; `mean_pressure` is then a guess, within twenty powers of ten.
  std::optional<double> offset;
  ChainEffort effort = ChainEffort::full;
  double length = 1;  // of gaps
  double tolerance = 1e-6;
};

struct CellAnswer {
  UnsetArray<double> pressure;  // feasible, exact at the bounds
  UnsetArray<double> gap;       // K p − h, freshly computed
  double offset = 0;
  // Light contact: gap and offset count from the highest node; the offset is the approach.
  bool from_peak = false;
  bool converged = false;
  int applications = 0;  // on the finest grid
  int levels = 1;
  bool single = false;
  std::string stage;
};

// On nx × ny nodes of the same tile, in cell units of the problem, gaps without offset; empty for none. At
// an offset on the same nodes pressures may be outside their bounds.
struct CellStart {
  int nx = 0, ny = 0;
  std::span<const double> pressure, gap;
};

// At a bound, the distance of the gap from leaving it, in pressure, replaces the pressure.
inline double level_set(double p, double upper, double apart) {
  return p <= 0 ? std::min(0.0, -apart) : p >= upper ? upper + std::max(0.0, -apart) : p;
}

// Nested grids are used without a start. Does not throw if the solve fails.
CellAnswer nested_descent(const CellProblem& problem, const CellStart& start, Monitor& monitor);

// Full elastic contact of a periodic tile, p = p̄ + (|q|/2) h. `converged` is false if this is infeasible.
// Two applications.
CellAnswer full_contact(const CellProblem& problem, Monitor& monitor);

}  // namespace asperity
