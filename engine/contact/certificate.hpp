// SPDX-License-Identifier: GPL-3.0-or-later
// Relative residuals of the contact conditions, from pressures and gaps alone. With pressure p, requested
// mean p̄, gap g and rms combined height r:
#pragma once

#include <algorithm>

namespace asperity {

struct Certificate {
  double penetration = 0;      // max(−g)⁺ / r at p below the cap
  double tension = 0;          // max(−p)⁺ / p̄
  double complementarity = 0;  // Σ p (g − min g) / (Σ p · r)
  double load = 0;             // |mean p − p̄| / p̄
  double cap = 0;              // max(p − H)⁺ / H; 0 without cap

  double attraction = 0;  // max |σ(g) − σ| / max σ; 0 without attraction across the gap

  double worst() const { return std::max({penetration, tension, complementarity, load, cap, attraction}); }
};

}  // namespace asperity
