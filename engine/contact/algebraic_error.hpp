// SPDX-License-Identifier: GPL-3.0-or-later
// How far the numbers of a solution can be from those of the exact solution on the same grid: bounds, not
// estimates, worked out from the pressures handed out and not from the way they were found. What they leave
// out is the error of the grid itself. Where a bound depends on which nodes touch, the nodes are parted into
// those that surely do, those that surely do not, and the rest.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/core/cost.hpp"
#include "engine/core/grid.hpp"

namespace asperity {

class Solution;

// Nodes of which it is certain that at least `low` and at most `high` do something.
struct NodeBracket {
  std::int64_t low = 0, high = 0;
};

// What a way of solving says of its solution; see AlgebraicError.
struct SolutionError {
  std::optional<double> load{};  // N
  double approach = 0;           // m
  double mean_gap = 0;           // m
  double energy = 0;             // J
  double peak_pressure = 0;      // Pa
  double plastic_volume = 0;     // m³
  NodeBracket contacts{};        // in contact
  NodeBracket yielded{};         // at the cap, or past their yield pressure
  // Nodes that may touch in the exact solution and not in this one, or the other way about.
  std::int64_t may_differ = 0;
};

// Each the greatest absolute difference from the exact solution of the same request on the same grid, in the
// unit of the quantity; infinite where nothing can be said. Computed with ordinary rounding, for which an
// allowance is made.
struct AlgebraicError {
  // 0 but for rounding where the load was asked for; none for a state pressed by `flatten`, whose other
  // bounds are against the exact solution under the load that was found.
  std::optional<double> load, pressure;
  double approach = 0;
  double indentation = 0;  // infinite where the combined heights are all equal
  double separation = 0;
  double mean_gap = 0;
  double energy = 0;
  double peak_pressure = 0;
  std::optional<double> secant_stiffness;  // none where there is none for the load
  double contacts = 0, area = 0, area_fraction = 0;
  double corrected_area_fraction = 0;
  NodeBracket contact_bracket;
  // None without the effect `plasticity`.
  std::optional<double> plastic_volume, plastic_fraction;
  std::optional<NodeBracket> yielded_bracket;

  std::int64_t nodes = 0;  // of the grid
  double node_area = 0;    // m²
  Cost cost;               // of finding all this
};

// The bounds of every quantity from those of a solution. Costs what solution.error() costs.
AlgebraicError find_algebraic_error(const Solution& solution, bool plastic);

}  // namespace asperity
