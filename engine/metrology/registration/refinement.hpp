// SPDX-License-Identifier: GPL-3.0-or-later
// Robust Gauss-Newton on shift, turn and plane between two maps: the after-map's heights less those of the
// before-map's spline at the places where the pose puts them, less a plane. Weights are Tukey's biweight
// (Beaton & Tukey 1974) with a scale taken from the residuals above zero alone: wear takes height away, so
// that only the upper side shows how well unworn ground agrees. Standard uncertainties by a jackknife
// that leaves out one of 4 x 4 tiles of the after-map at a time: residuals are correlated over the
// roughness, so the formal standard error would be several times too small.
#pragma once

#include "engine/metrology/registration/height_map.hpp"
#include "engine/metrology/registration/natural_spline.hpp"

namespace asperity::registration {

// Takes a place of the after-map to the before-map, both about their centres, in cells: turned by `turn` rad
// counter-clockwise, then shifted.
struct Pose {
  double x = 0, y = 0, turn = 0;
};

// What residuals are taken between. Both maps smoothed by the same Gaussian: between the nodes of one map
// noise would be averaged away most half-way, and least squares would be drawn to shifts by half a cell.
class MapPair {
 public:
  // Nodes count where at least `share` of the Gaussian fell on measured ones.
  MapPair(const SmoothMap& before, SmoothMap after, double share);

  const NaturalSpline& before() const { return spline_; }
  const HeightMap& after() const { return after_.map; }
  bool after_counts(int i, int j) const { return after_.share(i, j) >= share_; }
  // Place in nodes of the before-map; whether all four nodes around it count there.
  bool before_counts(double x, double y) const;
  double before_hx() const { return hx_; }
  double before_hy() const { return hy_; }
  // Cells² that count of either map, the smaller.
  double smaller_area() const { return smaller_area_; }

 private:
  double share_, hx_, hy_, smaller_area_;
  NaturalSpline spline_;
  Field before_share_;
  SmoothMap after_;
};

struct Refined {
  Pose pose;
  Plane plane;             // of the after-map above the before-map, in the after-map's frame
  double residual = 0;     // scale of the residuals above zero (1.4826 times their median)
  double explained = 0;    // weighted share of the variance of the heights that the pose explains; at most 1
  double overlap = 0;      // of the smaller map's area
  bool converged = false;  // last step below the tolerance
  bool possible = false;   // enough overlap, and relief for all six parameters
  bool relief = true;      // false: not possible for want of relief in some direction
};

struct RefinementOptions {
  int stride = 1;  // every how many nodes of the after-map, along x and y
  int most_steps = 30;
  double tolerance = 1e-5;  // cells, of the last step
  double least_overlap = 0.1;
  bool plane_alone = false;  // the pose stays as it is
  double tuning = 4.685;     // of the biweight, in scales
};

Refined refined(const MapPair& maps, const Pose& start, const RefinementOptions& options);

// The change of pose that the heights tell least about, of this length in cells at the rim of the after-map.
Pose weakest_change(const MapPair& maps, const Refined& found, const RefinementOptions& options,
                    double length);

// Standard uncertainties, in the units of what they belong to; not possible with less than 4 tiles that hold
// samples.
struct PoseUncertainty {
  bool possible = false;
  Pose pose;
  Plane plane;
};
PoseUncertainty jackknifed(const MapPair& maps, const Refined& found, const RefinementOptions& options);

// The plane at a pose that is found, by ground that is not worn. Beside worn ground the Gaussian that
// smoothed the maps spreads a little of what is lost, less than the noise, which the biweight lets pull the
// plane down: samples within `reach` cells of those that lie far off are left out. Not possible where little
// else is left.
struct UnwornPlane {
  bool possible = false;
  Plane plane;
  Plane u;  // standard uncertainties
};
UnwornPlane plane_of_unworn_ground(const MapPair& maps, const Refined& found, double reach,
                                   const RefinementOptions& options);

}  // namespace asperity::registration
