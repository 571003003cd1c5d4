// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/operations/missing_points.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/core/require.hpp"
#include "engine/surface/operations/holes.hpp"
#include "engine/surface/parallel_rows.hpp"

namespace asperity {

namespace {

constexpr double no_height = std::numeric_limits<double>::quiet_NaN();
// Gaussian standard deviation / median absolute deviation: 1/Φ⁻¹(3/4).
constexpr double deviation_over_mad = 1.4826022185056018;

void require_any_measured(std::span<const double> heights, const std::string& whole) {
  if (known_count(heights) == 0)
    refuse("no measured point of the " + whole + " remains: each has a missing neighbour",
           "fill the holes first, `" + whole + ":filled{ by=\"interpolate\" }`");
}

bool put_holes(std::span<double> heights, std::span<const double> mask, const std::string& whole) {
  const std::size_t before = known_count(heights);
  for (std::size_t k = 0; k < heights.size(); ++k)
    if (mask[k] == 0 || std::isnan(mask[k])) heights[k] = no_height;
  const std::size_t after = known_count(heights);
  if (after == 0)
    refuse("the mask leaves no measured point of the " + whole, "mark fewer points as not measured");
  return after < before;
}

void check_outlier_rule(const OutlierRule& rule) {
  require(std::isfinite(rule.factor) && rule.factor > 0, "factor", rule.factor, "",
          "give a finite number above 0, in standard deviations of Gaussian residuals");
  require(rule.window >= 3 && rule.window <= 31 && rule.window % 2 == 1, "window", rule.window, "nodes",
          "give an odd whole number from 3 to 31");
}

// NaN in holes.
Field median_residuals(const Field& z, int window, bool wraps_x, bool wraps_y, Monitor& monitor) {
  Field residuals(z.nx(), z.ny(), no_height);
  const int half = window / 2;
  const auto one_row = [&](int j, Array<double>& around) {
    for (int i = 0; i < z.nx(); ++i) {
      if (std::isnan(z(i, j))) continue;
      around.clear();
      for (int dj = -half; dj <= half; ++dj)
        for (int di = -half; di <= half; ++di) {
          int p = i + di, q = j + dj;
          if (wraps_x) p = wrapped_index(p, z.nx());
          if (wraps_y) q = wrapped_index(q, z.ny());
          if (p < 0 || p >= z.nx() || q < 0 || q >= z.ny() || std::isnan(z(p, q))) continue;
          around.push_back(z(p, q));
        }
      residuals(i, j) = z(i, j) - upper_median(around);
    }
  };
  for_each_row_reported(z.ny(), 0, monitor, "residuals of a median filter", one_row);
  return residuals;
}

Outliers outliers_of(const Field& z, const OutlierRule& rule, bool wraps_x, bool wraps_y, Monitor& monitor) {
  check_outlier_rule(rule);
  const Field residuals = median_residuals(z, rule.window, wraps_x, wraps_y, monitor);
  Array<double> known;
  std::copy_if(residuals.values().begin(), residuals.values().end(), std::back_inserter(known),
               [](double r) { return !std::isnan(r); });
  const double middle = upper_median(known);
  for (double& r : known) r = std::abs(r - middle);
  Outliers result;
  result.deviation = deviation_over_mad * upper_median(known);
  result.limit = rule.factor * result.deviation;
  const bool all_alike = std::all_of(known.begin(), known.end(), [](double r) { return r == 0; });
  if (result.deviation == 0 && !all_alike)
    refuse(
        "more than half of the heights differ equally from the median around them, so the rule \"mad\" would "
        "mark all others",
        "give a wider `window`, or mark the outliers with `mask`");
  result.mask = Field(z.nx(), z.ny());
  for (std::size_t k = 0; k < z.size(); ++k) {
    if (std::isnan(z[k])) continue;
    const bool outlying = std::abs(residuals[k] - middle) > result.limit;
    result.mask[k] = outlying ? 0 : 1;
    result.marked += outlying ? 1 : 0;
  }
  return result;
}

bool hole_on_rim(const Field& z) {
  for (int i = 0; i < z.nx(); ++i)
    if (std::isnan(z(i, 0)) || std::isnan(z(i, z.ny() - 1))) return true;
  for (int j = 0; j < z.ny(); ++j)
    if (std::isnan(z(0, j)) || std::isnan(z(z.nx() - 1, j))) return true;
  return false;
}

void check_fill(std::optional<double> height) {
  if (height) require(std::isfinite(*height), "value", *height, "m", "give a finite height");
}

}  // namespace

void fill_holes(Field& z, std::optional<double> height, double hx, double hy, Monitor& monitor) {
  if (!height) {
    fill_harmonic(z, hx, hy, monitor);
    return;
  }
  for (double& h : z.values())
    if (std::isnan(h)) h = *height;
}

Field line_of(const Profile& profile) {
  Field line(profile.size(), 1);
  std::ranges::copy(profile.measured_heights(), line.values().begin());
  return line;
}

Array<double> samples_of(const Field& line) { return {line.values().begin(), line.values().end()}; }

MeasuredValues::MeasuredValues(std::span<const double> values, bool complete) : values_(values) {
  if (complete) return;
  copy_.reserve(values.size());
  std::ranges::copy_if(values, std::back_inserter(copy_), [](double z) { return !std::isnan(z); });
  values_ = copy_;
}
MeasuredValues::MeasuredValues(const Surface& surface)
    : MeasuredValues(surface.measured_heights().values(), surface.complete()) {}
MeasuredValues::MeasuredValues(const Profile& profile)
    : MeasuredValues(profile.measured_heights(), profile.complete()) {}

Surface remade_with(bool holes, const Grid& grid, Field heights, SurfaceTraits traits) {
  if (!holes) return Surface(grid, std::move(heights), std::move(traits));
  require_any_measured(heights.values(), "surface");
  return Surface::with_holes(grid, std::move(heights), std::move(traits));
}

Profile remade_with(bool holes, double spacing, Array<double> heights, std::optional<double> closed_radius) {
  if (!holes) return Profile(spacing, std::move(heights), closed_radius);
  require_any_measured(heights, "profile");
  return Profile::with_holes(spacing, std::move(heights), closed_radius);
}

Field mask_of(const Surface& surface) {
  const Field& z = surface.measured_heights();
  Field mask(z.nx(), z.ny());
  for (std::size_t k = 0; k < z.size(); ++k) mask[k] = std::isnan(z[k]) ? 0 : 1;
  return mask;
}

Array<double> mask_of(const Profile& profile) {
  Array<double> mask;
  for (const double z : profile.measured_heights()) mask.push_back(std::isnan(z) ? 0 : 1);
  return mask;
}

Surface masked(const Surface& surface, const Field& mask) {
  const Grid& grid = surface.grid();
  if (mask.nx() != grid.nx || mask.ny() != grid.ny)
    refuse("the mask has " + std::to_string(mask.nx()) + " x " + std::to_string(mask.ny()) +
               " points, and the surface " + std::to_string(grid.nx) + " x " + std::to_string(grid.ny),
           "give a mask of the same cells");
  Field heights = surface.measured_heights();
  if (!put_holes(heights.values(), mask.values(), "surface")) return surface;
  SurfaceTraits traits = surface.traits();
  traits.aliased_share.reset();
  return Surface::with_holes(grid, std::move(heights), std::move(traits));
}

Profile masked(const Profile& profile, std::span<const double> mask) {
  if (mask.size() != static_cast<std::size_t>(profile.size()))
    refuse("the mask has " + std::to_string(mask.size()) + " points, and the profile " +
               std::to_string(profile.size()),
           "give a number a sample: 1 measured, 0 not");
  Array<double> heights(profile.measured_heights().begin(), profile.measured_heights().end());
  if (!put_holes(heights, mask, "profile")) return profile;
  return Profile::with_holes(profile.spacing(), std::move(heights), profile.closed_radius());
}

Outliers find_outliers(const Surface& surface, const OutlierRule& rule, Monitor& monitor) {
  const bool wraps = surface.traits().periodic;
  return outliers_of(surface.measured_heights(), rule, wraps, wraps, monitor);
}

Outliers find_outliers(const Profile& profile, const OutlierRule& rule) {
  return outliers_of(line_of(profile), rule, profile.closed(), false, Monitor::silent());
}

Surface filled(const Surface& surface, std::optional<double> height, Monitor& monitor) {
  check_fill(height);
  if (surface.complete()) return surface;
  const Grid& grid = surface.grid();
  Field heights = surface.measured_heights();
  SurfaceTraits traits = surface.traits();
  traits.periodic = traits.periodic && !hole_on_rim(heights);
  fill_holes(heights, height, grid.hx(), grid.hy(), monitor);
  return Surface(grid, std::move(heights), std::move(traits));
}

Profile filled(const Profile& profile, std::optional<double> height, Monitor& monitor) {
  check_fill(height);
  if (profile.complete()) return profile;
  Field line = line_of(profile);
  if (profile.closed() && !height) {
    // Gaps of an outline have two sides if it starts and ends at one measured sample.
    const auto values = profile.measured_heights();
    const auto start = static_cast<std::size_t>(
        std::find_if(values.begin(), values.end(), [](double z) { return !std::isnan(z); }) - values.begin());
    Field round(profile.size() + 1, 1);
    for (std::size_t k = 0; k < round.size(); ++k) round[k] = values[(start + k) % values.size()];
    fill_holes(round, height, profile.spacing(), profile.spacing(), monitor);
    for (std::size_t k = 0; k < values.size(); ++k) line[(start + k) % values.size()] = round[k];
  } else {
    fill_holes(line, height, profile.spacing(), profile.spacing(), monitor);
  }
  return Profile(profile.spacing(), samples_of(line), profile.closed_radius());
}

}  // namespace asperity
