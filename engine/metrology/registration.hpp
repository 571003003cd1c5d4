// SPDX-License-Identifier: GPL-3.0-or-later
// Laying a map measured after an event onto the map measured before it: shift, turn and tilt between the two,
// found from the ground that both share, through wear, noise and points not measured.
//
//   z_after(q) = z_before(p) + lift + tilt·(p − p0),   p = R(angle) (q − c) + c + shift,   p0 = c + shift
//
// with c the centre of the after-map's nodes and both maps' node (0, 0) at the origin: the after-map, turned
// counter-clockwise by `angle` about its centre and then moved by `shift`, lies on the before-map. Heights
// and lengths are not stretched. Coarse search over angles by whitened correlation
// (registration/coarse_search.hpp), then robust Gauss-Newton (registration/refinement.hpp).
#pragma once

#include <optional>

#include "engine/core/constants.hpp"
#include "engine/core/monitor.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

struct RegistrationOptions {
  double angle =
      6.283185307179586;  // rad, the greatest turn to either side; from half a turn on the whole circle
  std::optional<double> at_most;  // m, the greatest shift
};

// Standard uncertainties, from leaving out one of 4 x 4 tiles at a time.
struct RegistrationUncertainty {
  double shift_x = 0, shift_y = 0;  // m
  double angle = 0;                 // rad
  double tilt_x = 0, tilt_y = 0;    // slopes
  double lift = 0;                  // m
};

struct Registration {
  // The after-map on the grid of the before-map, less tilt and lift; not measured where the after-map does
  // not reach or one of its four nodes around the place was not measured. Between nodes a cubic spline.
  Surface surface;
  double shift_x = 0, shift_y = 0;  // m
  double angle = 0;                 // rad, from -pi to pi
  double tilt_x = 0, tilt_y = 0;    // slopes of the after-map above the before-map along the latter's axes
  double lift = 0;                  // m, height of the after-map above the before-map at the former's centre
  RegistrationUncertainty u{};
  double scale = 1;        // of lengths and heights: never stretched
  double residual = 0;     // m, scale of the differences above zero, both maps smoothed by one cell
  double overlap = 0;      // share of the before-map's measured nodes where `surface` is measured
  double explained = 0;    // share of the variance of the heights that the placement explains, where not worn
  double second_best = 0;  // the same of the best placement elsewhere; 0 where there is none
};

// Maps of different cells and sizes are laid on each other as they are, by their lengths. Cost: two
// transforms of some 512² an angle (360 angles on the whole circle, at most 15 within 5 degrees), then passes
// over the nodes. Memory: some 130 bytes a node where both maps have as many. Same bits for any number of
// threads. Throws Error{bad_value} for options out of range, a map that is flat or has fewer than 32 nodes
// along a side, and where the maps cannot tell: too little overlap, no placement that explains the heights,
// or another one that does so as well (ground that repeats itself, ridges without end, a sphere).
Registration registered(const Surface& after, const Surface& before, const RegistrationOptions& options = {},
                        Monitor& monitor = Monitor::silent());

}  // namespace asperity
