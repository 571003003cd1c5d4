// SPDX-License-Identifier: GPL-3.0-or-later
// Sums use fixed blocks.
#include "engine/surface/operations/heights.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/require.hpp"
#include "engine/surface/operations/missing_points.hpp"

namespace asperity {

namespace {

double deviation(std::span<const double> heights, double average, ScaleTo measure) {
  Array<double> terms(heights.size());
  if (measure == ScaleTo::ra) {
    for (std::size_t k = 0; k < heights.size(); ++k) terms[k] = std::abs(heights[k] - average);
    return mean(terms);
  }
  // Relative to the greatest deviation against underflow.
  double greatest = 0;
  for (const double h : heights) greatest = std::max(greatest, std::abs(h - average));
  if (greatest == 0) return 0;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const double ratio = (heights[k] - average) / greatest;
    terms[k] = ratio * ratio;
  }
  return greatest * std::sqrt(mean(terms));
}

template <class Change>
SurfaceRecipe then(std::shared_ptr<const SurfaceRecipe> recipe, Change change) {
  return [recipe, change](int nx, int ny, Monitor& monitor) {
    const Surface before = (*recipe)(nx, ny, monitor);
    Field heights = before.heights();
    change(heights);
    return Surface(before.grid(), std::move(heights), {.periodic = before.traits().periodic});
  };
}

// Scaling preserves periodicity and the aliased share; `bends` ends the latter.
template <class Change>
Surface changed(const Surface& surface, bool bends, const Change& change) {
  Field heights = surface.measured_heights();
  change(heights);
  SurfaceTraits traits = surface.traits();
  if (bends) traits.aliased_share.reset();
  const Surface result =
      remade_with(!surface.complete(), surface.grid(), std::move(heights), std::move(traits));
  return surface.recipe() ? result.made_by(then(surface.recipe(), change)) : result;
}

double cut_level(const Range& range, double fraction) {
  require(fraction >= 0 && fraction <= 1, "fraction", fraction, "",
          "give the part of the peak-to-valley height to cut off, from 0 to 1");
  // Exactly the lowest point.
  return fraction == 1 ? range.min : range.max - fraction * range.span();
}

void require_equal_grids(const Grid& a, const Grid& b, const char* done) {
  if (a.nx != b.nx || a.ny != b.ny)
    refuse("surfaces of " + std::to_string(a.nx) + " x " + std::to_string(a.ny) + " and " +
               std::to_string(b.nx) + " x " + std::to_string(b.ny) + " cells cannot be " + done,
           "bring one to the cells of the other with `resampled`");
  const auto differ = [](double u, double v) { return std::abs(u - v) > 1e-9 * std::max(u, v); };
  if (differ(a.size_x, b.size_x) || differ(a.size_y, b.size_y))
    refuse("surfaces of " + metres(a.size_x) + " x " + metres(a.size_y) + " and " + metres(b.size_x) + " x " +
               metres(b.size_y) + " cannot be " + done,
           "bring both to one size with `cropped`, then to the same cells with `resampled`");
}

template <class Combine>
Surface combined(const Surface& first, const Surface& second, const char* done, const Combine& combine,
                 Surface (*again)(const Surface&, const Surface&)) {
  require_equal_grids(first.grid(), second.grid(), done);
  Field heights = first.measured_heights();
  const Field& others = second.measured_heights();
  for (std::size_t k = 0; k < heights.size(); ++k) heights[k] = combine(heights[k], others[k]);
  const bool holes = !first.complete() || !second.complete();
  if (holes && known_count(heights.values()) == 0)
    refuse("the surfaces have no measured point in common",
           "fill the holes of one first, `surface:filled{ by=\"interpolate\" }`");
  const Surface result = remade_with(
      holes, first.grid(), std::move(heights),
      {.material = first.material(), .periodic = first.traits().periodic && second.traits().periodic});
  if (!first.recipe() || !second.recipe()) return result;
  return result.made_by(
      [one = first.recipe(), other = second.recipe(), again](int nx, int ny, Monitor& monitor) {
        return again((*one)(nx, ny, monitor), (*other)(nx, ny, monitor));
      });
}

}  // namespace

Surface scaled(const Surface& surface, ScaleTo measure, double target, ScaleAbout about) {
  const std::string key = measure == ScaleTo::amplitude ? "amplitude"
                          : measure == ScaleTo::rms     ? "rms"
                                                        : "ra";
  require(std::isfinite(target) && target >= 0, key, target, "m", "give a finite length of 0 or more");
  const Range range = surface.height_range();
  const MeasuredValues measured(surface);
  const double average = mean(measured.values());
  if (range.span() == 0 && target > 0)
    refuse("a flat surface cannot be scaled to " + quoted(key) + " = " + format_short(target) + " m",
           "scale a surface that has some height");
  const double now = range.span() == 0               ? 1.0
                     : measure == ScaleTo::amplitude ? range.span()
                                                     : deviation(measured.values(), average, measure);
  const double fixed = about == ScaleAbout::mean ? average : range.min;
  // target / now can overflow or underflow; then deviations are divided first.
  const double factor = target / now;
  const bool direct = std::isfinite(factor) && factor > 1e-290;
  return changed(surface, false, [=](Field& z) {
    for (double& h : z.values()) h = fixed + (direct ? (h - fixed) * factor : (h - fixed) / now * target);
  });
}

Surface times(const Surface& surface, double factor) {
  require(std::isfinite(factor), "factor", factor, "", "give a finite number");
  return changed(surface, factor == 0, [factor](Field& z) {
    for (double& h : z.values()) h *= factor;
  });
}

Surface over(const Surface& surface, double divisor) {
  require(std::isfinite(divisor) && divisor != 0, "divisor", divisor, "",
          "give a finite number other than 0");
  return changed(surface, false, [divisor](Field& z) {
    for (double& h : z.values()) h /= divisor;
  });
}

Surface plus(const Surface& first, const Surface& second) {
  return combined(first, second, "added", std::plus<>(), plus);
}

Surface minus(const Surface& first, const Surface& second) {
  return combined(first, second, "subtracted", std::minus<>(), minus);
}

Surface cut(const Surface& surface, double fraction) {
  const double level = cut_level(surface.height_range(), fraction);
  return changed(surface, fraction > 0, [level](Field& z) {
    for (double& h : z.values()) h = std::min(h, level);  // keeps NaN: first argument
  });
}

Profile cut(const Profile& profile, double fraction) {
  const double level = cut_level(profile.height_range(), fraction);
  Array<double> heights(profile.measured_heights().begin(), profile.measured_heights().end());
  for (double& h : heights) h = std::min(h, level);
  return remade_with(!profile.complete(), profile.spacing(), std::move(heights), profile.closed_radius());
}

}  // namespace asperity
