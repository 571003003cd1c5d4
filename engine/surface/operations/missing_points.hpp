// SPDX-License-Identifier: GPL-3.0-or-later
// Points of a measured map or profile that were not measured: which they are, more of them by a mask or by a
// named rule for outliers, and heights in their place for who asks. What computes new heights from old ones
// uses `remade_with` to pass holes on, and `MeasuredValues` where it needs measured heights alone.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "engine/core/grid.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"
#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// The measured heights in the order of the nodes, without gaps. Of a map without holes the heights
// themselves, which must outlive it; otherwise a copy.
class MeasuredValues {
 public:
  explicit MeasuredValues(const Surface& surface);
  explicit MeasuredValues(const Profile& profile);
  MeasuredValues(const MeasuredValues&) = delete;
  MeasuredValues& operator=(const MeasuredValues&) = delete;
  std::span<const double> values() const { return values_; }

 private:
  MeasuredValues(std::span<const double> values, bool complete);
  Array<double> copy_;
  std::span<const double> values_;
};

// New heights that were computed from maps which have holes, or have none: NaN is a hole where they have
// some, and a mistake where they have none. Throws Error{bad_value} where nothing that was measured remains.
Surface remade_with(bool holes, const Grid& grid, Field heights, SurfaceTraits traits);
Profile remade_with(bool holes, double spacing, Array<double> heights,
                    std::optional<double> closed_radius = {});

// 1 where a point was measured, 0 where it was not.
Field mask_of(const Surface& surface);
Array<double> mask_of(const Profile& profile);

// The points at which `mask` is 0 or NaN count as not measured, beside those that were not. The share of
// variance past Nyquist is not known any more where that changes something. Throws Error{bad_value} for a
// mask of other cells, and where nothing measured remains.
Surface masked(const Surface& surface, const Field& mask);
Profile masked(const Profile& profile, std::span<const double> mask);

// A rule by which outliers are marked, "mad": a point is one if its height less the median of the measured
// points around it (a square of `window` nodes a side, itself included, cut off at the rim) is farther from
// the median of all such residuals than `factor` times their scaled median absolute deviation, which of
// Gaussian residuals is their standard deviation (1.4826 MAD).
struct OutlierRule {
  double factor = 6;  // above 0; 6 standard deviations of Gaussian residuals are met once in 5e8 points
  int window = 5;     // nodes a side, odd, 3 … 31
};

// What a rule found.
struct Outliers {
  Field mask;              // 1 where a point is measured and no outlier
  std::size_t marked = 0;  // points
  double deviation = 0;    // m, scaled median absolute deviation of the residuals
  double limit = 0;        // m, factor times deviation
};

// O(nodes · window²); two copies of the grid. Same bits for any number of threads. Throws Error{bad_value}
// naming `factor` or `window`, and where more than half of the residuals are equal (heights in few steps, a
// plateau, ground that is smoother than the window), so that their deviation of zero would make an outlier of
// every other point.
Outliers find_outliers(const Surface& surface, const OutlierRule& rule, Monitor& monitor = Monitor::silent());
// Along the profile: a stretch of `window` samples; of a closed outline it goes round.
Outliers find_outliers(const Profile& profile, const OutlierRule& rule);

// Heights in the place of every point that was not measured: this height, or none for the harmonic
// continuation of the heights around (io/holes.hpp), which of a profile is the straight line between the
// samples beside a gap, and at an end the last height. A map without holes stays what it is. Periodic as
// before unless a hole touches the rim. Throws Error{bad_value} for a height that is not finite.
Surface filled(const Surface& surface, std::optional<double> height, Monitor& monitor = Monitor::silent());
Profile filled(const Profile& profile, std::optional<double> height, Monitor& monitor = Monitor::silent());

}  // namespace asperity
