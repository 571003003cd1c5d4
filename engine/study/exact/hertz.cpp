// SPDX-License-Identifier: GPL-3.0-or-later
// Frictionless paraboloid of radius R on a half-space (Hertz 1882; Johnson, Contact Mechanics, §4.2):
//   a² = R δ,  F = (4/3) E* √R δ^(3/2),  p0 = 3F/(2πa²),  U = (2/5) F δ.
#include "engine/study/exact/closed_forms.hpp"

#include <cmath>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/constants.hpp"

namespace asperity::exact {

namespace {

Hertz complete(double radius, double load, double approach) {
  Hertz contact;
  contact.load = load;
  contact.approach = approach;
  contact.contact_radius = std::sqrt(radius) * std::sqrt(approach);
  contact.area = pi * radius * approach;
  contact.peak_pressure = 1.5 * load / contact.area;
  contact.energy = 0.4 * load * approach;
  in_range({contact.load, contact.approach, contact.area, contact.peak_pressure, contact.energy});
  return contact;
}

}  // namespace

Hertz hertz_under_load(double radius, double modulus, double load) {
  const double root = elementary::cbrt(0.75 * load / modulus);
  return complete(radius, load, root * (root / elementary::cbrt(radius)));
}

Hertz hertz_at_approach(double radius, double modulus, double approach) {
  return complete(radius, 4.0 / 3 * modulus * (std::sqrt(radius) * std::sqrt(approach) * approach), approach);
}

double friction(const Hertz& contact, double tau0, double alpha, double tau_max) {
  const double law = tau0 * contact.area + alpha * contact.load;
  if (tau_max >= tau0 + alpha * contact.peak_pressure) return law;
  if (tau_max <= tau0) return tau_max * contact.area;
  const double edge = (tau_max - tau0) / (alpha * contact.peak_pressure);  // p_c/p0
  const double outside = contact.area * (edge * edge);
  return tau_max * (contact.area - outside) + tau0 * outside + alpha * contact.load * (edge * edge * edge);
}

}  // namespace asperity::exact
