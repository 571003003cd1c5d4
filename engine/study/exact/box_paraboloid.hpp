// SPDX-License-Identifier: GPL-3.0-or-later
// A paraboloid of radius R on independent elements of stiffness k (Winkler): pressure k(δ − r²/2R), so
//   F = πkRδ²,  A = 2πRδ,  U = Fδ/3.
#pragma once

namespace asperity::exact {

struct BoxParaboloid {
  double load = 0;      // N
  double approach = 0;  // m
  double area = 0;      // m²
  double energy = 0;    // J, elastic
};

// `radius` m, `stiffness` Pa/m, all > 0. Throws Error{bad_value} where a result leaves the range of a double.
BoxParaboloid box_paraboloid_under_load(double radius, double stiffness, double load);
BoxParaboloid box_paraboloid_at_approach(double radius, double stiffness, double approach);

}  // namespace asperity::exact
