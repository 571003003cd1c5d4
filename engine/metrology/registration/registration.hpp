// SPDX-License-Identifier: GPL-3.0-or-later
// Registers a map after an event to the map before, despite wear, noise and holes.
//
//   z_after(q) = z_before(p) + lift + tilt·(p − p0),   p = R(angle) (q − c) + c + shift,   p0 = c + shift
//
// c: centre of the after-map's nodes; node (0, 0) of both maps: origin. The after-map turns counter-clockwise
// about its centre, then shifts, unstretched.
#pragma once

#include <optional>

#include "engine/core/monitor.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

struct RegistrationOptions {
  double angle = 6.283185307179586;  // rad to either side; from pi on the whole circle
  std::optional<double> at_most;     // m
};

// Standard uncertainties (jackknife).
struct RegistrationUncertainty {
  double shift_x = 0, shift_y = 0;  // m
  double angle = 0;                 // rad
  double tilt_x = 0, tilt_y = 0;    // slopes
  double lift = 0;                  // m
};

struct Registration {
  // After-map on the before-map's grid without tilt and lift; cubic spline. Holes outside the after-map or
  // next to missing nodes.
  Surface surface;
  double shift_x = 0, shift_y = 0;  // m
  double angle = 0;                 // rad, from -pi to pi
  double tilt_x = 0, tilt_y = 0;    // slopes of after- above before-map, along the latter's axes
  double lift = 0;                  // m, after- above before-map, at the former's centre
  RegistrationUncertainty u{};
  double scale = 1;        // never stretched
  double residual = 0;     // m, scale of positive differences after smoothing by one cell
  double overlap = 0;      // measured share of the before-map's measured nodes
  double explained = 0;    // explained share of the variance of unworn heights
  double second_best = 0;  // `explained` of the best placement elsewhere; 0: none
};

// Cells and sizes may differ. Cost: two transforms of about 512² per angle (360, or at most 15 within 5
// degrees), then passes over nodes. Memory: about 130 bytes per node. Throws Error{bad_value} for options out
// of range, flat maps, under 32 nodes along a side, little overlap, and unexplained or ambiguous heights
// (repeating, ridges, a sphere).
Registration registered(const Surface& after, const Surface& before, const RegistrationOptions& options = {},
                        Monitor& monitor = Monitor::silent());

}  // namespace asperity
