// SPDX-License-Identifier: GPL-3.0-or-later
// Paraboloid of radius R on a Winkler foundation, pressure k(δ − r²/2R): F = πkRδ², A = 2πRδ, U = Fδ/3.
#include "engine/study/exact/closed_forms.hpp"

#include <cmath>
#include <numbers>

namespace asperity::exact {

namespace {

BoxParaboloid complete_boxes(double radius, double load, double approach) {
  BoxParaboloid contact{load, approach, 2 * std::numbers::pi * radius * approach, load * approach / 3};
  in_range({contact.load, contact.approach, contact.area, contact.energy});
  return contact;
}

}  // namespace

BoxParaboloid box_paraboloid_under_load(double radius, double stiffness, double load) {
  return complete_boxes(radius, load, std::sqrt(load / (std::numbers::pi * stiffness)) / std::sqrt(radius));
}

BoxParaboloid box_paraboloid_at_approach(double radius, double stiffness, double approach) {
  return complete_boxes(radius, std::numbers::pi * stiffness * (radius * approach * approach), approach);
}

}  // namespace asperity::exact
