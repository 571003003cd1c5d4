// SPDX-License-Identifier: GPL-3.0-or-later
// Measures of a solution's error: relative residuals of the contact conditions, and bounds on its numbers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

namespace asperity {

// From pressures p and gaps g alone; requested mean p̄, rms combined height r.
struct Certificate {
  double penetration = 0;      // max(−g)⁺ / r at p below the cap
  double tension = 0;          // max(−p)⁺ / p̄
  double complementarity = 0;  // Σ p (g − min g) / (Σ p · r)
  double load = 0;             // |mean p − p̄| / p̄
  double cap = 0;              // max(p − H)⁺ / H; 0 without cap

  double attraction = 0;  // max |σ(g) − σ| / max σ; 0 without attraction

  double worst() const { return std::max({penetration, tension, complementarity, load, cap, attraction}); }
};

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
  // Nodes in contact in one solution only, at most.
  std::int64_t may_differ = 0;
};

}  // namespace asperity
