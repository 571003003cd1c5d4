// SPDX-License-Identifier: GPL-3.0-or-later
// Missing points: masks, outlier rules, filling.
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

// Without holes a view of the heights, which must outlive it; otherwise a copy.
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

// NaN is a hole if `holes`, else an error. Throws Error{bad_value} if no measured point remains.
Surface remade_with(bool holes, const Grid& grid, Field heights, SurfaceTraits traits);
Profile remade_with(bool holes, double spacing, Array<double> heights,
                    std::optional<double> closed_radius = {});

// The samples as a field of ny = 1, and back.
Field line_of(const Profile& profile);
Array<double> samples_of(const Field& line);

// 1: measured, 0: missing.
Field mask_of(const Surface& surface);
Array<double> mask_of(const Profile& profile);

// `mask` 0 or NaN makes a hole; the aliased share is then dropped. Throws Error{bad_value} for a mask of
// other size or if no measured point remains.
Surface masked(const Surface& surface, const Field& mask);
Profile masked(const Profile& profile, std::span<const double> mask);

// Rule "mad". Residual: height minus the median of the measured heights in a square of `window` nodes a side
// (periodic, or clipped at the rim). An outlier differs from the median residual by more than `factor` times
// 1.4826 MAD, the standard deviation of Gaussian residuals.
struct OutlierRule {
  double factor = 6;  // > 0; 6 Gaussian deviations: one point in 5e8
  int window = 5;     // nodes a side, odd, 3 … 31
};

struct Outliers {
  Field mask;  // 1: measured and no outlier
  std::size_t marked = 0;
  double deviation = 0;  // m, 1.4826 MAD
  double limit = 0;      // m, factor · deviation
};

// O(nodes · window²); two copies of the grid. Throws Error{bad_value} naming `factor` or `window`, and if
// most residuals are equal (coarse steps, a plateau, a smooth surface).
Outliers find_outliers(const Surface& surface, const OutlierRule& rule, Monitor& monitor = Monitor::silent());
// `window` samples; a closed outline wraps.
Outliers find_outliers(const Profile& profile, const OutlierRule& rule);

// By `height`, else harmonically; cells are hx by hy metres.
void fill_holes(Field& z, std::optional<double> height, double hx, double hy, Monitor& monitor);

// Fills with `height`, else harmonically (holes.hpp); in a profile linearly across gaps and constant at
// ends. A hole on the rim ends periodicity. Throws Error{bad_value} for a non-finite height.
Surface filled(const Surface& surface, std::optional<double> height, Monitor& monitor = Monitor::silent());
Profile filled(const Profile& profile, std::optional<double> height, Monitor& monitor = Monitor::silent());

}  // namespace asperity
