// SPDX-License-Identifier: GPL-3.0-or-later
// How far a solution is from satisfying the contact conditions, evaluated from the pressures and gaps
// it hands out and not from the way it was found. All entries are relative, so that lengths and
// moduli may be rescaled freely. With pressure p, requested mean p̄, gap g and rms combined height r:
#pragma once

#include <algorithm>

namespace asperity {

struct Certificate {
  double penetration = 0;      // max(−g)⁺ / r where p is below the cap
  double tension = 0;          // max(−p)⁺ / p̄
  double complementarity = 0;  // Σ p (g − min g) / (Σ p · r)
  double load = 0;             // |mean p − p̄| / p̄
  double cap = 0;              // max(p − H)⁺ / H; 0 where no cap is in force

  double attraction = 0;  // max |σ(g) − σ| / max σ; 0 without attraction across the gap

  // The greatest entry: the residual of the solve.
  double worst() const { return std::max({penetration, tension, complementarity, load, cap, attraction}); }
};

}  // namespace asperity
