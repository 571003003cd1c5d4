// SPDX-License-Identifier: GPL-3.0-or-later
// Sums use fixed blocks.
#include "engine/surface/operations/heights.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/core/error.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/operations/missing_points.hpp"

namespace asperity {

namespace {

double deviation(std::span<const double> heights, double average, ScaleTo measure) {
  Array<double> terms(heights.size());
  if (measure == ScaleTo::ra) {
    for (std::size_t k = 0; k < heights.size(); ++k) terms[k] = std::abs(heights[k] - average);
    return mean(terms);
  }
  // Relative to the greatest deviation, so that squares of nanometres do not underflow.
  double greatest = 0;
  for (const double h : heights) greatest = std::max(greatest, std::abs(h - average));
  if (greatest == 0) return 0;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const double ratio = (heights[k] - average) / greatest;
    terms[k] = ratio * ratio;
  }
  return greatest * std::sqrt(mean(terms));
}

std::string key_of(ScaleTo measure) {
  return measure == ScaleTo::amplitude ? "amplitude" : measure == ScaleTo::rms ? "rms" : "ra";
}

// Repeats the change, with its original numbers.
template <class Change>
SurfaceRecipe then(std::shared_ptr<const SurfaceRecipe> recipe, Change change) {
  return [recipe, change](int nx, int ny, Monitor& monitor) {
    const Surface before = (*recipe)(nx, ny, monitor);
    Field heights = before.heights();
    change(heights);
    return Surface(before.grid(), std::move(heights),
                   {.material = {}, .periodic = before.traits().periodic, .aliased_share = {}});
  };
}

// Scaling preserves periodicity and the aliased share.
template <class Change>
Surface changed(const Surface& surface, bool flat, const Change& change) {
  Field heights = surface.measured_heights();
  change(heights);
  SurfaceTraits traits = surface.traits();
  if (flat) traits.aliased_share.reset();
  const Surface result =
      remade_with(!surface.complete(), surface.grid(), std::move(heights), std::move(traits));
  return surface.recipe() ? result.made_by(then(surface.recipe(), change)) : result;
}

double cut_level(const Range& range, double fraction) {
  require(fraction >= 0 && fraction <= 1, "fraction", fraction, "",
          "give the part of the peak-to-valley height to cut off, from 0 to 1");
  // Exactly the lowest point, without rounding.
  return fraction == 1 ? range.min : range.max - fraction * range.span();
}

}  // namespace

Surface scaled(const Surface& surface, ScaleTo measure, double target, ScaleAbout about) {
  const std::string key = key_of(measure);
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
  Field heights = surface.measured_heights();
  // target / now can overflow or underflow for extreme heights; then deviations are divided first.
  const double factor = target / now;
  const bool direct = std::isfinite(factor) && factor > 1e-290;
  const auto stretch = [=](Field& z) {
    for (double& h : z.values()) h = fixed + (direct ? (h - fixed) * factor : (h - fixed) / now * target);
  };
  stretch(heights);
  const Surface result =
      remade_with(!surface.complete(), surface.grid(), std::move(heights), surface.traits());
  return surface.recipe() ? result.made_by(then(surface.recipe(), stretch)) : result;
}

Surface times(const Surface& surface, double factor) {
  require(std::isfinite(factor), "factor", factor, "", "give a finite number");
  const auto multiply = [factor](Field& z) {
    for (double& h : z.values()) h *= factor;
  };
  return changed(surface, factor == 0, multiply);
}

Surface over(const Surface& surface, double divisor) {
  require(std::isfinite(divisor) && divisor != 0, "divisor", divisor, "",
          "give a finite number other than 0");
  const auto divide = [divisor](Field& z) {
    for (double& h : z.values()) h /= divisor;
  };
  return changed(surface, false, divide);
}

namespace {

void require_equal_grids(const Grid& a, const Grid& b, const char* done) {
  if (a.nx != b.nx || a.ny != b.ny)
    refuse("surfaces of " + std::to_string(a.nx) + " x " + std::to_string(a.ny) + " and " +
               std::to_string(b.nx) + " x " + std::to_string(b.ny) + " cells cannot be " + done,
           "bring one to the cells of the other with `resampled`");
  const auto differ = [](double u, double v) { return std::abs(u - v) > 1e-9 * std::max(u, v); };
  if (differ(a.size_x, b.size_x) || differ(a.size_y, b.size_y))
    refuse("surfaces of " + format_short(a.size_x) + " x " + format_short(a.size_y) + " m and " +
               format_short(b.size_x) + " x " + format_short(b.size_y) + " m cannot be " + done,
           "bring both to one size with `cropped`, then to the same cells with `resampled`");
}

template <class Combine>
Surface combined(const Surface& first, const Surface& second, const Combine& combine,
                 Surface (*again)(const Surface&, const Surface&)) {
  Field heights = first.measured_heights();
  const Field& others = second.measured_heights();
  for (std::size_t k = 0; k < heights.size(); ++k) heights[k] = combine(heights[k], others[k]);
  const bool holes = !first.complete() || !second.complete();
  if (holes && known_count(heights.values()) == 0)
    refuse("there is no point at which both surfaces were measured",
           "fill the holes of one first, `surface:filled{ by=\"interpolate\" }`");
  const Surface result = remade_with(holes, first.grid(), std::move(heights),
                                     {.material = first.material(),
                                      .periodic = first.traits().periodic && second.traits().periodic,
                                      .aliased_share = {}});
  if (!first.recipe() || !second.recipe()) return result;
  return result.made_by(
      [one = first.recipe(), other = second.recipe(), again](int nx, int ny, Monitor& monitor) {
        return again((*one)(nx, ny, monitor), (*other)(nx, ny, monitor));
      });
}

}  // namespace

Surface plus(const Surface& first, const Surface& second) {
  require_equal_grids(first.grid(), second.grid(), "added");
  return combined(
      first, second, [](double a, double b) { return a + b; }, plus);
}

Surface minus(const Surface& first, const Surface& second) {
  require_equal_grids(first.grid(), second.grid(), "subtracted");
  return combined(
      first, second, [](double a, double b) { return a - b; }, minus);
}

Surface cut(const Surface& surface, double fraction) {
  const double level = cut_level(surface.height_range(), fraction);
  Field heights = surface.measured_heights();
  const auto flatten = [level](Field& z) {
    for (double& h : z.values()) h = std::min(h, level);  // keeps NaN: first argument
  };
  flatten(heights);
  SurfaceTraits traits = surface.traits();
  if (fraction > 0) traits.aliased_share.reset();
  const Surface result =
      remade_with(!surface.complete(), surface.grid(), std::move(heights), std::move(traits));
  return surface.recipe() ? result.made_by(then(surface.recipe(), flatten)) : result;
}

Profile cut(const Profile& profile, double fraction) {
  const double level = cut_level(profile.height_range(), fraction);
  Array<double> heights(profile.measured_heights().begin(), profile.measured_heights().end());
  for (double& h : heights) h = std::min(h, level);
  return remade_with(!profile.complete(), profile.spacing(), std::move(heights), profile.closed_radius());
}

}  // namespace asperity
