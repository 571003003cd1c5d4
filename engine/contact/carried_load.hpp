// SPDX-License-Identifier: GPL-3.0-or-later
// What two bodies have carried as they lie. Ground that gave way under a load fits the other body under it:
// the pressures that left it so are, unchanged, the exact solution of the same load again, with nothing more
// to yield, and no pressure is greater under a lighter one. What a solve finds beyond is its own error; taken
// for yield, it would wear away a specimen that is pressed again and again.
#pragma once

#include <algorithm>
#include <vector>

namespace asperity {

struct CarriedLoad {
  double pressure = 0;   // Pa, mean over the tile
  double softening = 1;  // hardness under it over the one stated

  // Whether ground that carried this gives way no more under `other`.
  bool covers(const CarriedLoad& other) const {
    return other.pressure <= pressure && other.softening >= softening;
  }
};

inline bool covered(const std::vector<CarriedLoad>& carried, const CarriedLoad& load) {
  return std::any_of(carried.begin(), carried.end(), [&](const CarriedLoad& c) { return c.covers(load); });
}

// Adds a load; those that it covers are left out.
inline void carry(std::vector<CarriedLoad>& carried, const CarriedLoad& load) {
  if (covered(carried, load)) return;
  std::erase_if(carried, [&](const CarriedLoad& c) { return load.covers(c); });
  carried.push_back(load);
}

}  // namespace asperity
