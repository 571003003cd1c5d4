// SPDX-License-Identifier: GPL-3.0-or-later
// A paraboloid of radius R pressed into a half-space (Hertz 1882; Johnson, Contact Mechanics, §4.2):
//   a² = R δ,  F = (4/3) E* √R δ^(3/2),  p0 = 3F/(2πa²),  U = (2/5) F δ,
// with E* the contact modulus of the two bodies. The free half-space, without friction or adhesion.
#pragma once

namespace asperity::exact {

struct Hertz {
  double load = 0;            // N
  double approach = 0;        // m
  double contact_radius = 0;  // m
  double area = 0;            // m²
  double peak_pressure = 0;   // Pa, in the middle; it falls as √(1 − (r/a)²)
  double energy = 0;          // J, elastic
};

// `radius` m, `modulus` E* Pa, all > 0. Throws Error{bad_value} where a result leaves the range of a double.
Hertz hertz_under_load(double radius, double modulus, double load);
Hertz hertz_at_approach(double radius, double modulus, double approach);

// The sum of τ = min(τ0 + αp, τ_max) over the contact, N. With p_c = (τ_max − τ0)/α and
// r_c² = a²(1 − (p_c/p0)²) the inner circle carries τ_max: T = τ_max π r_c² + τ0 π(a² − r_c²) + αF (p_c/p0)³.
// τ0 and α >= 0, τ_max > 0 (infinite: no cap).
double friction(const Hertz& contact, double tau0, double alpha, double tau_max);

}  // namespace asperity::exact
