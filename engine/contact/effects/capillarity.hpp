// SPDX-License-Identifier: GPL-3.0-or-later
// Capillarity: liquid fills gaps below the meniscus height and pulls with the Laplace pressure p = γ/r.
// Kelvin radius r = γ V_m/(R T |ln h|) at humidity h; height 2 r cos θ; work p times height. One energy of
// the gap: constant traction up to the height (falling over half of it to either side, at equal work). The
// liquid is not conserved.
#pragma once

#include "engine/contact/scene/effect.hpp"

namespace asperity {

// Either the pressure, or the humidity.
struct CapillarityOptions {
  std::optional<double> pressure{};  // Pa
  std::optional<double> humidity{};  // relative, 0 … 1
  double surface_tension = 0.0728;   // γ, N/m; water at 20 °C
  double contact_angle = 0;          // θ, rad
  double temperature = 293.15;       // T, K
  double molar_volume = 1.8e-5;      // V_m, m³/mol
  static const Effect& effect();
};

// Both 0 without a meniscus.
struct Meniscus {
  double pressure = 0;  // Pa
  double height = 0;    // m
};
Meniscus meniscus(const CapillarityOptions& options);

}  // namespace asperity
