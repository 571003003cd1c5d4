// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds (not estimates) on the difference between the numbers of a solution and the exact solution on the
// same grid, computed from its pressures. The error of the grid is not included.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/core/cost.hpp"
#include "engine/core/grid.hpp"

namespace asperity {

class Solution;

// At least `low` and at most `high` nodes.
struct NodeBracket {
  std::int64_t low = 0, high = 0;
};

// Reported by a solver; see AlgebraicError.
struct SolutionError {
  std::optional<double> load{};  // N
  double approach = 0;           // m
  double mean_gap = 0;           // m
  double energy = 0;             // J
  double peak_pressure = 0;      // Pa
  double plastic_volume = 0;     // m³
  NodeBracket contacts{};        // in contact
  NodeBracket yielded{};         // at the cap, or past the yield pressure
  // Nodes in contact in one of the two solutions only, at most.
  std::int64_t may_differ = 0;
};

// Greatest absolute differences from the exact solution of the same request on the same grid, rounding
// included, in the unit of the quantity; infinite if unknown.
struct AlgebraicError {
  // Rounding only if the load was prescribed. None after a press by `flatten`: the other bounds then refer
  // to the exact solution under the load found.
  std::optional<double> load, pressure;
  double approach = 0;
  double indentation = 0;  // infinite for equal combined heights
  double separation = 0;
  double mean_gap = 0;
  double energy = 0;
  double peak_pressure = 0;
  std::optional<double> secant_stiffness;  // none if none for the load
  double contacts = 0, area = 0, area_fraction = 0;
  double corrected_area_fraction = 0;
  NodeBracket contact_bracket;
  // None without the effect `plasticity`.
  std::optional<double> plastic_volume, plastic_fraction;
  std::optional<NodeBracket> yielded_bracket;

  std::int64_t nodes = 0;  // of the grid
  double node_area = 0;    // m²
  Cost cost;               // of computing this
};

// As costly as solution.error().
AlgebraicError find_algebraic_error(const Solution& solution, bool plastic);

}  // namespace asperity
