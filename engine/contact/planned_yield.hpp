// SPDX-License-Identifier: GPL-3.0-or-later
// Pressure limit and division of the plastic approach, as planned: 0 <= p <= H, or H + K_h w with hardening.
// The plastic approach w is taken from both bodies by lower_plastic_share of their present hardness at each
// node. Volume is removed, not redistributed. Rigid bodies and flat counter-bodies take no share.
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

// A load carried as placed: same or lighter loads cause no further yield. Computed further yield is solver
// error and must not wear the specimen.
struct CarriedLoad {
  double pressure = 0;   // Pa, mean over the tile
  double softening = 1;  // hardness in the press over stated hardness

  // Whether `other` causes no further yield.
  bool covers(const CarriedLoad& other) const {
    return other.pressure <= pressure && other.softening >= softening;
  }
};

inline bool covered(const std::vector<CarriedLoad>& carried, const CarriedLoad& load) {
  return std::any_of(carried.begin(), carried.end(), [&](const CarriedLoad& c) { return c.covers(load); });
}

// Adds `load` and erases the loads it covers.
inline void carry(std::vector<CarriedLoad>& carried, const CarriedLoad& load) {
  if (covered(carried, load)) return;
  std::erase_if(carried, [&](const CarriedLoad& c) { return load.covers(c); });
  carried.push_back(load);
}

// Permanent, after a press.
struct PlasticChange {
  Field approach;  // w, m: plastic part of the local approach, both bodies
  // Pa, at the reference dwell; 0 at nodes without yield. Empty without hardening.
  Field hardness;
  // None if the solve missed its tolerance.
  std::optional<CarriedLoad> carried{};
};

// A body without a share has infinite hardness.
struct PlannedYield {
  double lower_hardness = 0, upper_hardness = 0;  // Pa, at the reference dwell, before events
  double hardening = 0;                           // K_h, Pa/m; infinite: the pressure is capped
  // E_lower/E_upper; 1 if unknown or without elasticity.
  double modulus_ratio = 1;
  // H(dwell, s)/H; none: independent of the dwell.
  std::function<double(std::optional<double> dwell)> softening{};
  // Loads carried as placed now.
  std::vector<CarriedLoad> carried{};

  double hardness() const { return std::min(lower_hardness, upper_hardness); }
  bool limits() const { return std::isfinite(hardness()); }
  bool hardens() const { return limits() && std::isfinite(hardening); }
  double softened(std::optional<double> dwell) const { return softening ? softening(dwell) : 1.0; }
};

// Lower body's share of the plastic approach,
//   s = 1/(1 + exp(1.5 (ρ² − ρ⁻²)) E_lower/E_upper),  ρ = H_lower/H_upper:
// ½ for like bodies; .25, .06, .004 for a body 1.2, 1.5, 2 times as hard. Within .03 of J2 plasticity below
// the surface with one Poisson's ratio; exact for equal hardness. 0 or 1 if the other hardness is infinite.
double lower_plastic_share(double lower_hardness, double upper_hardness, double modulus_ratio = 1);

// BodyMemory: hardness of hardened nodes, Pa at the reference dwell.
inline constexpr std::string_view hardness_memory = "hardness";

// Both bodies as placed, at the lower body's nodes; none if uniform.
MetMemory local_hardness(const ContactGeometry& geometry, const PlannedYield& yield);

// With the hardness scaled by `factor`.
YieldLaw yield_law(const PlannedYield& yield, const MetMemory& local, double factor);

// In the bodies' own frames.
struct YieldedBodies {
  Surface lower;
  UpperBody upper;
  NodeMemory hardness;
  // Mapped over intended volume of the upper body, before rescaling.
  double mapped_volume = 1;
};

// Maps only the increment; heights are never resampled. O(n).
YieldedBodies yielded_bodies(const ContactGeometry& geometry, const PlannedYield& yield,
                             const PlasticChange& change);

}  // namespace asperity
