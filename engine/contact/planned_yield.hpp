// SPDX-License-Identifier: GPL-3.0-or-later
// What limits the pressure of a contact and which body gives way, as a plan has it: 0 <= p <= H, and the
// plastic approach w that the limit leaves open is taken from both bodies, half each of like ones and nearly
// all from the softer of unlike ones (lower_plastic_share), by the hardness that each node has by then. With
// hardening a node carries H + K_h w instead. Volume is removed, not redistributed; a rigid body and a flat
// counter-body take no share.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/yield_law.hpp"

namespace asperity {

// What two bodies have carried as they lie. Ground that gave way under a load fits the other body under it:
// the pressures that left it so are, unchanged, the exact solution of the same load again, with nothing more
// to yield, and no pressure is greater under a lighter one. What a solve finds beyond is its own error; taken
// for yield, it would wear away a specimen that is pressed again and again.
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

struct PlasticChange;

// A body that takes no share of what yields has infinite hardness here.
struct PlannedYield {
  double lower_hardness = 0, upper_hardness = 0;  // Pa, at the reference dwell, before any event
  double hardening = 0;                           // K_h, Pa/m; infinite: the pressure is capped
  // E of the lower body over that of the upper one; 1 where one of them is not known or nothing is elastic.
  double modulus_ratio = 1;
  // H(dwell, s)/H; none: the hardness does not depend on how long a press lasts.
  std::function<double(std::optional<double> dwell)> softening{};
  // The loads that the bodies have carried as they lie now; under none of them does a node yield again.
  std::vector<CarriedLoad> carried{};

  double hardness() const { return std::min(lower_hardness, upper_hardness); }
  bool limits() const { return std::isfinite(hardness()); }  // whether anything can yield
  bool hardens() const { return limits() && std::isfinite(hardening); }
  double softened(std::optional<double> dwell) const { return softening ? softening(dwell) : 1.0; }
};

// The share of the plastic approach that the lower of two bodies takes,
//   s = 1/(1 + exp(1.5 (ρ² − ρ⁻²)) E_lower/E_upper),  ρ = H_lower/H_upper:
// ½ each of like bodies, .25 of a body 1.2 times as hard as the other, .06 of one 1.5 times and .004 of one
// twice as hard, which hardly yields at the pressure that the softer one limits. What J2 plasticity below the
// surface gives, within .03 between loads, of bodies of one Poisson's ratio; of equal hardness and unlike E
// it is exact: the strains go as 1/E. All or nothing where the other body's hardness is infinite.
double lower_plastic_share(double lower_hardness, double upper_hardness, double modulus_ratio = 1);

// The name of the BodyMemory that holds the hardness of each node after hardening, Pa at the reference dwell.
inline constexpr std::string_view hardness_memory = "hardness";

// The hardness of each node with the other body on it, each as the lower body's nodes meet it; none where it
// is the same everywhere.
MetMemory local_hardness(const ContactGeometry& geometry, const PlannedYield& yield);

// What limits the pressure while the hardness is `factor` of the one stated.
YieldLaw yield_law(const PlannedYield& yield, const MetMemory& local, double factor);

// The bodies after an event, in their own frames.
struct YieldedBodies {
  Surface lower;
  UpperBody upper;
  NodeMemory hardness;
  // Of what the upper body lost: mapped off the lattice over meant, before it was scaled to be equal.
  double mapped_volume = 1;
};

// Takes `change` from the bodies of `geometry`. Stored heights are never resampled: only the increment is
// mapped. O(n).
YieldedBodies yielded_bodies(const ContactGeometry& geometry, const PlannedYield& yield,
                             const PlasticChange& change);

}  // namespace asperity
