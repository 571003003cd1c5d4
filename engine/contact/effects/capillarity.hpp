// SPDX-License-Identifier: GPL-3.0-or-later
// Capillarity: liquid bridges the gaps lower than a meniscus and pulls with the pressure of Laplace, p = γ/r.
// Its radius follows from the humidity, r = γ V_m/(R T |ln h|) (Kelvin), its height is 2 r cos θ, its work p
// times that height. Its one term is an energy of the gap, constant in traction up to the height (ending over
// half of it to either side, the work unchanged). Liquid is neither conserved nor in the way.
#pragma once

#include "engine/contact/effect.hpp"

namespace asperity {

// Either the pressure is given, or the humidity, which sets the radius.
struct CapillarityOptions {
  std::optional<double> pressure{};  // Pa
  std::optional<double> humidity{};  // relative, 0 … 1
  double surface_tension = 0.0728;   // γ, N/m; water at 20 °C
  double contact_angle = 0;          // θ, rad
  double temperature = 293.15;       // T, K
  double molar_volume = 1.8e-5;      // V_m, m³/mol
  static const Effect& effect();
};

// As a term: its work, its height and p = work/height. No term has work 0 at humidity 0 and pressure 0.
struct Meniscus {
  double pressure = 0;  // Pa
  double height = 0;    // m
};
Meniscus meniscus(const CapillarityOptions& options);

}  // namespace asperity
