// SPDX-License-Identifier: GPL-3.0-or-later
// The hills and dales of a surface, ISO 25178-2: Spd, Spc, S5p, S5v, S10z. A map is flooded from its summits
// down; where two hills meet, at their saddle, the one of the lower summit ends there. A hill counts where
// its summit stands at least `pruning` of Sz above its saddle (Wolf pruning by height, 5 %): equivalently,
// where its summit is the highest sample of its connected part of {z > summit - pruning·Sz}. Without pruning
// the number is that of the noise. Neighbours are the eight around a node; summits at the rim or beside a
// hole end no hill but do not count, for what is past them was not measured. Dales are the hills of the map
// upside down.
#pragma once

#include <cstddef>
#include <optional>

#include "engine/surface/surface.hpp"

namespace asperity {

struct Hills {
  std::size_t peaks = 0, pits = 0;
  double Spd = 0, Svd = 0;  // 1/m², peaks and pits per measured area
  std::optional<double>
      Spc;  // 1/m, mean of -(zxx + zyy)/2 at the peaks by three samples each way; none without peaks
  std::optional<double> S5p;   // m, mean height of the five highest peaks above the mean; none under five
  std::optional<double> S5v;   // m, mean depth of the five deepest pits; none under five
  std::optional<double> S10z;  // S5p + S5v
};

// One sort: n log n; takes some 20 bytes a node and side. `pruning` is a share of Sz, 0 to 1. Throws
// Error{bad_value} outside. The same for any number of threads.
Hills hills(const Surface& surface, double pruning = 0.05);

}  // namespace asperity
