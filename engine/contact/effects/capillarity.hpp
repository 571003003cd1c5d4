// SPDX-License-Identifier: GPL-3.0-or-later
// Capillarity: liquid bridges the gaps lower than a meniscus and pulls with the pressure of Laplace, p = γ/r.
// Its radius follows from the humidity, r = γ V_m/(R T |ln h|) (Kelvin), its height is 2 r cos θ, its work p
// times that height. Its one term is an energy of the gap, constant in traction up to the height (ending over
// half of it to either side, the work unchanged). Liquid is neither conserved nor in the way.
#pragma once

#include "engine/contact/plan.hpp"

namespace asperity {

// As a term: its work, its height and p = work/height. No term has work 0 at humidity 0 and pressure 0.
struct Meniscus {
  double pressure = 0;  // Pa
  double height = 0;    // m
};
Meniscus meniscus(const CapillarityOptions& options);

void plan_capillarity(const CapillarityOptions& options, const ContactGeometry& geometry, Plan& plan);

}  // namespace asperity
