// SPDX-License-Identifier: GPL-3.0-or-later
// Robust Gauss-Newton on shift, turn and plane between after-map and before-map's spline. Tukey's biweight
// (Beaton & Tukey 1974) is scaled by positive residuals only: wear removes height. Standard uncertainties use
// a jackknife over 4 x 4 tiles, because residuals are correlated.
#pragma once

#include "engine/metrology/registration/height_map.hpp"
#include "engine/metrology/registration/natural_spline.hpp"

namespace asperity::registration {

// Maps the after-map to the before-map, about their centres, in cells: turn in rad, counter-clockwise, then
// shift.
struct Pose {
  double x = 0, y = 0, turn = 0;
};

// Both maps need one Gaussian: interpolation averages noise between nodes and attracts half-cell shifts.
class MapPair {
 public:
  // Nodes with a measured share of at least `share` count.
  MapPair(const SmoothMap& before, SmoothMap after, double share);

  const NaturalSpline& before() const { return spline_; }
  const HeightMap& after() const { return after_.map; }
  bool after_counts(int i, int j) const { return after_.share(i, j) >= share_; }
  // Place in nodes; true if all four nodes around count.
  bool before_counts(double x, double y) const;
  double before_hx() const { return hx_; }
  double before_hy() const { return hy_; }
  // Smaller counting area of both, cells².
  double smaller_area() const { return smaller_area_; }

 private:
  double share_, hx_, hy_, smaller_area_;
  NaturalSpline spline_;
  Field before_share_;
  SmoothMap after_;
};

struct Refined {
  Pose pose;
  Plane plane;           // after-map above before-map, in the after-map's frame
  double residual = 0;   // 1.4826 · median of positive residuals
  double explained = 0;  // weighted share of the variance, at most 1
  double overlap = 0;    // share of the smaller map
  bool converged = false;
  bool possible = false;  // enough overlap and relief
  bool relief = true;     // false: some direction has no relief
};

struct RefinementOptions {
  int stride = 1;  // nodes of the after-map per sample, along x and y
  int most_steps = 30;
  double tolerance = 1e-5;  // cells
  double least_overlap = 0.1;
  bool plane_alone = false;  // fix the pose
  double tuning = 4.685;     // of the biweight, in scales
};

Refined refined(const MapPair& maps, const Pose& start, const RefinementOptions& options);

// Weakest direction of the pose, `length` cells at the after-map's rim.
Pose weakest_change(const MapPair& maps, const Refined& found, const RefinementOptions& options,
                    double length);

// Impossible with fewer than 4 tiles with samples.
struct PoseUncertainty {
  bool possible = false;
  Pose pose;
  Plane plane;
};
PoseUncertainty jackknifed(const MapPair& maps, const Refined& found, const RefinementOptions& options);

// Plane of the unworn surface. Smoothing spreads wear to its neighbourhood, below the noise, and pulls the
// plane down; samples within `reach` cells of outliers are left out. Impossible if few remain.
struct UnwornPlane {
  bool possible = false;
  Plane plane;
  Plane u;  // standard uncertainties
};
UnwornPlane plane_of_unworn_ground(const MapPair& maps, const Refined& found, double reach,
                                   const RefinementOptions& options);

}  // namespace asperity::registration
