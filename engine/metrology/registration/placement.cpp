// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/registration/placement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/require.hpp"
#include "engine/metrology/registration/coarse_search.hpp"

namespace asperity::registration {

namespace {

constexpr int least_coarse_cells = 16, usual_coarse_cells = 256, most_coarse_cells = 2048;  // along a side
constexpr double degree = std::numbers::pi / 180;
constexpr double least_overlap = 0.1;    // of the smaller map
constexpr double least_explained = 0.5;  // of the variance
constexpr double firmly_explained = 0.9;
constexpr double gaussian_reach = 3;  // standard deviations
// A second placement is as good below this multiple of the best's unexplained variance.
constexpr double clearly_worse = 1.5, least_difference = 5e-4;

// Required measured share; lower if scattered holes would exclude most nodes.
double share_that_counts(const SmoothMap& before, const SmoothMap& after, const HeightMap& before_raw,
                         const HeightMap& after_raw) {
  const auto counting = [](const SmoothMap& map, const HeightMap& raw, double share) {
    std::size_t counts = 0;
    for (const double value : map.share.values()) counts += value >= share ? 1 : 0;
    return static_cast<double>(counts) /
           static_cast<double>(std::max<std::size_t>(1, known_count(raw.heights.values())));
  };
  for (const double share : {0.99, 0.9})
    if (std::min(counting(before, before_raw, share), counting(after, after_raw, share)) >= 0.6) return share;
  return 0.7;
}

MapPair smoothed_alike(const HeightMap& before, const HeightMap& after, double sigma) {
  const SmoothMap smooth_before = smoothed_map(before, sigma);
  SmoothMap smooth_after = smoothed_map(after, sigma);
  const double share = share_that_counts(smooth_before, smooth_after, before, after);
  return MapPair(smooth_before, std::move(smooth_after), share);
}

struct Judged {
  Refined best;
  double second = 0;  // variance explained elsewhere
  double moved = 0;   // variance explained a few cells away, in the weakest direction
};

bool elsewhere(const Pose& a, const Pose& b, double way, double turn) {
  return elementary::hypot(a.x - b.x, a.y - b.y) > way ||
         std::abs(std::remainder(a.turn - b.turn, 2 * std::numbers::pi)) > turn;
}

// Refines candidates, then shifts the best both ways along its weakest direction: on ridges or spheres this
// fits as well. The shifted pose stays fixed: refinement would follow rim and noise.
Judged judged(const HeightMap& before, const HeightMap& after, const std::vector<Candidate>& candidates,
              const CoarseOptions& search, Monitor& monitor) {
  const double spacing = before.hx;
  const MapPair maps = smoothed_alike(before, after, 1.5 * spacing);
  RefinementOptions options;
  options.most_steps = 20;
  options.tolerance = 1e-3 * spacing;
  options.least_overlap = least_overlap;
  std::vector<Refined> found;
  bool relief = true;
  Task task(monitor, "comparing places of the map", static_cast<std::int64_t>(candidates.size()));
  for (const Candidate& candidate : candidates) {
    const Refined one = refined(maps, candidate.pose, options);
    relief = relief && one.relief;
    const double shift = elementary::hypot(one.pose.x - search.from_x, one.pose.y - search.from_y);
    // The search resolves its cells only.
    if (one.possible && shift <= search.greatest_shift + 2 * spacing) found.push_back(one);
    task.advance();
  }
  if (found.empty() && !relief)
    refuse("the surface has no features along one direction, so the after-map has no definite place",
           "measure a place with features in every direction");
  if (found.empty())
    refuse("no placement of the after-map makes the two maps overlap enough",
           "measure more of the same place, or search more angles and longer shifts (`angle`, `at_most`)");
  const auto best = std::max_element(found.begin(), found.end(), [](const Refined& a, const Refined& b) {
    return a.explained < b.explained;
  });
  Judged result{*best, 0, 0};
  for (const Refined& other : found)
    if (elsewhere(other.pose, best->pose, 3 * spacing, 2 * search.step))
      result.second = std::max(result.second, other.explained);
  const double way = 4 * spacing;
  const Pose change = weakest_change(maps, *best, options, way);
  for (const double side : {-1.0, 1.0}) {
    const Pose start{best->pose.x + side * change.x, best->pose.y + side * change.y,
                     best->pose.turn + side * change.turn};
    RefinementOptions there = options;
    there.plane_alone = true;
    there.most_steps = 6;
    const Refined moved = refined(maps, start, there);
    if (moved.possible) result.moved = std::max(result.moved, moved.explained);
  }
  return result;
}

std::string percent_of(double share) {
  return std::to_string(static_cast<int>(std::lround(100 * share))) + " %";
}

void refuse_what_is_not_decided(const Refined& found, const Judged& coarse) {
  if (found.explained < least_explained || coarse.best.explained < least_explained)
    refuse("the best placement explains " +
               percent_of(std::max(0.0, std::min(found.explained, coarse.best.explained))) +
               " of the heights: the maps show different places, or too much wear",
           "search more angles and longer shifts (`angle`, `at_most`), or take maps of one specimen");
  const double as_good = std::max(clearly_worse * (1 - coarse.best.explained), least_difference);
  const double other = std::max(coarse.moved, coarse.second);
  if (coarse.best.explained < firmly_explained && 1 - other < as_good)
    refuse("no placement stands out: the best explains " + percent_of(coarse.best.explained) +
               " of the heights, another one " + percent_of(other),
           "take maps that show more of the same place, or search more angles and longer shifts");
  if (1 - coarse.moved < as_good)
    refuse(
        "the after-map fits a few cells away as well: the surface has no features along one direction, or "
        "looks the same when it is turned",
        "measure a place with features in every direction");
  if (1 - coarse.second < as_good)
    refuse("another placement explains the heights as well (" + percent_of(coarse.second) + ", the best " +
               percent_of(coarse.best.explained) + "): the surface repeats itself",
           "narrow the search with `angle` and `at_most`, or measure a place with distinct features");
}

// Smoothed heights need few samples.
int stride_of(const HeightMap& map) {
  constexpr double most_samples = 1 << 19;
  return std::max(
      1,
      static_cast<int>(std::ceil(std::sqrt(static_cast<double>(map.heights.size()) / most_samples) - 1e-9)));
}

std::string extent_of(const HeightMap& map, double cell) {
  return metres((map.extent_x() + map.hx) * cell) + " x " + metres((map.extent_y() + map.hy) * cell);
}

// Coarse maps: about 256² nodes; more for small or narrow maps.
double coarse_spacing(const HeightMap& before, const HeightMap& after, double widest) {
  const double longest = std::max({after.extent_x(), after.extent_y(), before.extent_x(), before.extent_y()});
  const double shortest =
      std::min({after.extent_x(), after.extent_y(), before.extent_x(), before.extent_y()});
  const double area = std::max(after.extent_x() * after.extent_y(), before.extent_x() * before.extent_y());
  return std::max({2 * widest, longest / (most_coarse_cells - 1),
                   std::min(std::sqrt(area) / (usual_coarse_cells - 1), shortest / least_coarse_cells)});
}

CoarseOptions coarse_options(const HeightMap& before, const HeightMap& after, const PlacementLimits& limits) {
  CoarseOptions search;
  search.greatest_turn = std::min(limits.greatest_turn, std::numbers::pi);
  search.greatest_shift = limits.greatest_shift;
  search.from_x = 0.5 * (after.extent_x() - before.extent_x());
  search.from_y = 0.5 * (after.extent_y() - before.extent_y());
  search.step = limits.greatest_turn >= std::numbers::pi ? degree : 0.75 * degree;
  // A small map resembles more places.
  const auto [smaller, area] =
      std::minmax({after.extent_x() * after.extent_y(), before.extent_x() * before.extent_y()});
  if (smaller < 0.25 * area) {
    search.candidates = 32;
    search.of_an_angle = 12;
  }
  return search;
}

}  // namespace

Placement find_placement(const HeightMap& before, const HeightMap& after, const PlacementLimits& limits,
                         Monitor& monitor) {
  const double widest = std::max({after.hx, after.hy, before.hx, before.hy});
  const double spacing = coarse_spacing(before, after, widest);
  const HeightMap coarse_before = coarser_map(before, spacing), coarse_after = coarser_map(after, spacing);
  const int fewest = std::min({coarse_after.nx(), coarse_after.ny(), coarse_before.nx(), coarse_before.ny()});
  const double ratio = std::max(after.hx, after.hy) / std::max(before.hx, before.hy);
  if (fewest < least_coarse_cells && spacing <= 2 * widest && ratio < 2 && ratio > 0.5)
    refuse("the search moves the maps in steps of " + metres(spacing * limits.cell) +
               ", twice their longest cell, and " + std::to_string(fewest) +
               " steps along a side are fewer than " + std::to_string(least_coarse_cells),
           "give the maps square cells with `resampled`, or measure on more cells");
  if (fewest < least_coarse_cells || known_count(coarse_after.heights.values()) == 0 ||
      known_count(coarse_before.heights.values()) == 0)
    refuse("the maps have too little in common: one is " + extent_of(after, limits.cell) + " and the other " +
               extent_of(before, limits.cell),
           "crop the larger one, or measure both with like cells");
  const CoarseOptions search = coarse_options(before, after, limits);
  const std::vector<Candidate> candidates = coarse_candidates(coarse_before, coarse_after, search, monitor);
  const Judged coarse = judged(coarse_before, coarse_after, candidates, search, monitor);

  // On large maps the coarse error may exceed the shortest waves.
  RefinementOptions options;
  options.least_overlap = least_overlap;
  Pose start = coarse.best.pose;
  for (double step = spacing / 3; step >= 2 * widest; step /= 3) {
    const HeightMap coarser_before = coarser_map(before, step), coarser_after = coarser_map(after, step);
    options.stride = stride_of(coarser_after);
    options.tolerance = 1e-3 * step;
    start = refined(smoothed_alike(coarser_before, coarser_after, 1.5 * step), start, options).pose;
  }
  const MapPair maps = smoothed_alike(before, after, widest);
  options.stride = stride_of(after);
  options.tolerance = 1e-5;
  options.most_steps = 60;
  Refined found = refined(maps, start, options);
  if (!found.possible)
    refuse("the best placement leaves " + percent_of(found.overlap) +
               " of the smaller map on the other, or no relief there",
           "measure more of the same place");
  refuse_what_is_not_decided(found, coarse);
  PoseUncertainty u = jackknifed(maps, found, options);
  if (!u.possible)
    refuse("the overlap of the maps is too small to estimate the uncertainty of the placement",
           "measure more of the same place");
  // Chance can explain few features; then the tiles disagree.
  const double radius = 0.5 * std::max(after.extent_x(), after.extent_y());
  const double loose = std::max({u.pose.x, u.pose.y, u.pose.turn * radius});
  if (found.explained < firmly_explained && loose > 0.25 * widest)
    refuse("the best placement explains " + percent_of(found.explained) +
               " of the heights, and the parts of the map disagree by " + metres(loose * limits.cell) +
               " about it",
           "measure a larger place with distinct features, or narrow the search with `angle` and `at_most`");
  const UnwornPlane unworn = plane_of_unworn_ground(maps, found, gaussian_reach * widest, options);
  if (unworn.possible) {
    found.plane = unworn.plane;
    u.plane = unworn.u;
  }
  return {found, u, coarse.second};
}

}  // namespace asperity::registration
