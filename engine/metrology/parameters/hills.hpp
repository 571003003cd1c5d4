// SPDX-License-Identifier: GPL-3.0-or-later
// Hills and dales, ISO 25178-2: Spd, Spc, S5p, S5v, S10z. A hill counts if its summit is `pruning` · Sz or
// more above the saddle (Wolf pruning, 5 %; unpruned numbers follow noise). Eight neighbours. Summits at rims
// or holes do not count. Dales: hills of the inverted map.
#pragma once

#include <cstddef>
#include <optional>

#include "engine/surface/surface.hpp"

namespace asperity {

struct Hills {
  std::size_t peaks = 0, pits = 0;
  double Spd = 0, Svd = 0;     // 1/m², per measured area
  std::optional<double> Spc;   // 1/m, mean of -(zxx + zyy)/2 at the peaks; empty without peaks
  std::optional<double> S5p;   // m, mean height of the five highest peaks about the mean
  std::optional<double> S5v;   // m, mean depth of the five deepest pits
  std::optional<double> S10z;  // S5p + S5v; all three empty with fewer than five
};

// Cost n log n; about 20 bytes per node and side. Throws Error{bad_value} unless `pruning` is in 0 … 1.
Hills hills(const Surface& surface, double pruning = 0.05);

}  // namespace asperity
