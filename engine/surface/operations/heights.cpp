// SPDX-License-Identifier: GPL-3.0-or-later
// Plain loops over the nodes; sums in fixed blocks.
#include "engine/surface/operations/heights.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/core/error.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

double deviation(const Field& heights, double average, ScaleTo measure) {
  Array<double> terms(heights.size());
  if (measure == ScaleTo::ra) {
    for (std::size_t k = 0; k < heights.size(); ++k) terms[k] = std::abs(heights[k] - average);
    return mean(terms);
  }
  // Relative to the greatest deviation, so that squares of nanometres do not vanish.
  double greatest = 0;
  for (const double h : heights.values()) greatest = std::max(greatest, std::abs(h - average));
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

// The recipe of a surface whose heights were changed node by node, with the numbers of the first time.
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

double cut_level(const Range& range, double fraction) {
  require(fraction >= 0 && fraction <= 1, "fraction", fraction, "",
          "give the part of the peak-to-valley height to cut off, from 0 to 1");
  // At 1 the level is the lowest point itself, not what rounding makes of it.
  return fraction == 1 ? range.min : range.max - fraction * range.span();
}

}  // namespace

Surface scaled(const Surface& surface, ScaleTo measure, double target, ScaleAbout about) {
  const std::string key = key_of(measure);
  require(std::isfinite(target) && target >= 0, key, target, "m", "give a finite length of 0 or more");
  const Range range = surface.height_range();
  const double average = mean(surface.heights().values());
  if (range.span() == 0 && target > 0)
    throw Error(ErrorCode::bad_value,
                "a flat surface cannot be scaled to " + quoted(key) + " = " + format_short(target) + " m",
                "scale a surface that has some height");
  const double now = range.span() == 0               ? 1.0
                     : measure == ScaleTo::amplitude ? range.span()
                                                     : deviation(surface.heights(), average, measure);
  const double fixed = about == ScaleAbout::mean ? average : range.min;
  Field heights = surface.heights();
  // Multiply, then divide: the quotient alone would overflow for heights near the smallest double.
  const double factor = target / now;
  const bool direct = std::isfinite(factor) && factor > 1e-290;
  const auto stretch = [=](Field& z) {
    for (double& h : z.values()) h = fixed + (direct ? (h - fixed) * factor : (h - fixed) / now * target);
  };
  stretch(heights);
  const Surface result(surface.grid(), std::move(heights), surface.traits());
  return surface.recipe() ? result.made_by(then(surface.recipe(), stretch)) : result;
}

Surface plus(const Surface& first, const Surface& second) {
  const Grid &a = first.grid(), &b = second.grid();
  if (a.nx != b.nx || a.ny != b.ny)
    throw Error(ErrorCode::bad_value,
                "surfaces of " + std::to_string(a.nx) + " x " + std::to_string(a.ny) + " and " +
                    std::to_string(b.nx) + " x " + std::to_string(b.ny) + " cells cannot be added",
                "bring one to the cells of the other with `resampled`");
  const auto differ = [](double u, double v) { return std::abs(u - v) > 1e-9 * std::max(u, v); };
  if (differ(a.size_x, b.size_x) || differ(a.size_y, b.size_y))
    throw Error(ErrorCode::bad_value,
                "surfaces of " + format_short(a.size_x) + " x " + format_short(a.size_y) + " m and " +
                    format_short(b.size_x) + " x " + format_short(b.size_y) + " m cannot be added",
                "bring both to one size with `cropped`, then to the same cells with `resampled`");
  Field heights = first.heights();
  for (std::size_t k = 0; k < heights.size(); ++k) heights[k] += second.heights()[k];
  const Surface sum(a, std::move(heights),
                    {.material = first.material(),
                     .periodic = first.traits().periodic && second.traits().periodic,
                     .aliased_share = {}});
  if (!first.recipe() || !second.recipe()) return sum;
  return sum.made_by([one = first.recipe(), other = second.recipe()](int nx, int ny, Monitor& monitor) {
    return plus((*one)(nx, ny, monitor), (*other)(nx, ny, monitor));
  });
}

Surface cut(const Surface& surface, double fraction) {
  const double level = cut_level(surface.height_range(), fraction);
  Field heights = surface.heights();
  const auto flatten = [level](Field& z) {
    for (double& h : z.values()) h = std::min(h, level);
  };
  flatten(heights);
  SurfaceTraits traits = surface.traits();
  if (fraction > 0) traits.aliased_share.reset();
  const Surface result(surface.grid(), std::move(heights), std::move(traits));
  return surface.recipe() ? result.made_by(then(surface.recipe(), flatten)) : result;
}

Profile cut(const Profile& profile, double fraction) {
  const double level = cut_level(profile.height_range(), fraction);
  Array<double> heights(profile.heights().begin(), profile.heights().end());
  for (double& h : heights) h = std::min(h, level);
  return Profile(profile.spacing(), std::move(heights), profile.closed_radius());
}

}  // namespace asperity
