// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/registration.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/require.hpp"
#include "engine/metrology/registration/coarse_search.hpp"
#include "engine/metrology/registration/height_map.hpp"
#include "engine/metrology/registration/natural_spline.hpp"
#include "engine/metrology/registration/refinement.hpp"
#include "engine/surface/io/holes.hpp"

namespace asperity {

namespace registration {
namespace {

constexpr int least_cells = 32, most_coarse_cells = 256;
constexpr double degree = std::numbers::pi / 180;
constexpr double least_overlap = 0.1;    // of the smaller map
constexpr double least_explained = 0.5;  // of the variance of the heights
constexpr double firmly_explained = 0.9;
// A second placement is as good where it leaves less than this many times the variance unexplained.
constexpr double clearly_worse = 1.5, least_difference = 5e-4;

struct Prepared {
  HeightMap map;  // heights in rms of the before-map, lengths in cells
  Plane plane;    // that was taken off, m over cells
};

Prepared prepared(const Surface& surface, const char* which, double cell) {
  const Grid& grid = surface.grid();
  if (std::min(grid.nx, grid.ny) < least_cells)
    refuse(std::string(which) + " has " + std::to_string(grid.nx) + " x " + std::to_string(grid.ny) +
               " cells; fewer than 32 along a side cannot be registered",
           "measure on more cells");
  Prepared result;
  result.map = levelled_map(surface, cell, result.plane);
  // What is left of a plane by rounding is no relief.
  const double rounding =
      1e-13 * std::max(std::abs(surface.height_range().min), std::abs(surface.height_range().max));
  if (!(rms_height(result.map) > rounding))
    refuse(std::string(which) + " is flat but for its tilt: nothing tells where it lies",
           "register a rough surface");
  return result;
}

void divide_heights(HeightMap& map, double unit) {
  for (double& value : map.heights.values()) value /= unit;
}

// The share of a Gaussian that has to fall on measured nodes for its middle to count: nearly all, unless so
// many points are missing one by one that little would be left.
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

struct Judged {
  Refined best;
  double second = 0;  // explained by the best placement elsewhere
  double moved = 0;   // explained a few cells away, along what the heights tell least about
};

bool elsewhere(const Pose& a, const Pose& b, double way, double turn) {
  return elementary::hypot(a.x - b.x, a.y - b.y) > way ||
         std::abs(std::remainder(a.turn - b.turn, 2 * std::numbers::pi)) > turn;
}

// All candidates, refined on the coarse maps; and the best one moved both ways along what the heights tell
// least about: along a ridge, or where a sphere is turned about its top, that is as good as before.
// Refinement would bring it back, to where rim and noise of the two maps happen to agree.
Judged judged(const HeightMap& before, const HeightMap& after, const std::vector<Candidate>& candidates,
              const CoarseOptions& search, Monitor& monitor) {
  const double spacing = before.hx, sigma = 1.5 * spacing;
  const SmoothMap before_smooth = smoothed_map(before, sigma);
  SmoothMap after_smooth = smoothed_map(after, sigma);
  const double share = share_that_counts(before_smooth, after_smooth, before, after);
  const MapPair maps(before_smooth, std::move(after_smooth), share);
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
    // The search is as coarse as its cells.
    if (one.possible && shift <= search.greatest_shift + 2 * spacing) found.push_back(one);
    task.advance();
  }
  if (found.empty() && !relief)
    refuse("the ground has no features across one direction: nothing tells where the after-map lies along it",
           "measure ground with features of its own in every direction");
  if (found.empty())
    refuse("no placement of the after-map leaves enough of the two maps on top of each other",
           "measure more of the same ground, or search more angles and longer shifts (`angle`, `at_most`)");
  const auto best = std::max_element(found.begin(), found.end(), [](const Refined& a, const Refined& b) {
    return a.explained < b.explained;
  });
  Judged result{*best, 0};
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

// The after-map on the nodes of the before-map.
Field laid_on(const HeightMap& after, const HeightMap& before, const Pose& pose, const Plane& plane,
              const Plane& before_plane, double unit, Monitor& monitor) {
  Field filled = after.heights;
  const bool holes = known_count(filled.values()) < filled.size();
  if (holes) fill_harmonic(filled, after.hx, after.hy, monitor);
  const NaturalSpline spline(filled);
  const auto [sine, cosine] = elementary::sincos(pose.turn);
  Field result(before.nx(), before.ny());
  const auto row = [&](int j) {
    for (int i = 0; i < before.nx(); ++i) {
      const double at_x = before.x(i), at_y = before.y(j);
      const double dx = at_x - pose.x, dy = at_y - pose.y;
      const double x = cosine * dx + sine * dy, y = -sine * dx + cosine * dy;
      double u = x / after.hx + 0.5 * (after.nx() - 1), v = y / after.hy + 0.5 * (after.ny() - 1);
      double& height = result(i, j);
      height = std::numeric_limits<double>::quiet_NaN();
      // A node on the rim stays there, by the error of its place.
      constexpr double rounding = 1e-3;
      if (!(u >= -rounding && v >= -rounding && u <= after.nx() - 1 + rounding &&
            v <= after.ny() - 1 + rounding))
        continue;
      u = std::clamp(u, 0.0, after.nx() - 1.0);
      v = std::clamp(v, 0.0, after.ny() - 1.0);
      const int a = static_cast<int>(u + rounding), b = static_cast<int>(v + rounding);
      const int a1 = u - a > rounding ? a + 1 : a, b1 = v - b > rounding ? b + 1 : b;
      if (std::isnan(after.heights(a, b)) || std::isnan(after.heights(a1, b)) ||
          std::isnan(after.heights(a, b1)) || std::isnan(after.heights(a1, b1)))
        continue;
      const double levelled = spline.at(u, v).height - plane.height - plane.slope_x * x - plane.slope_y * y;
      height =
          levelled * unit + before_plane.height + before_plane.slope_x * at_x + before_plane.slope_y * at_y;
    }
  };
  parallel_for((before.ny() + 7) / 8, [&](std::int64_t turn) {
    for (int j = static_cast<int>(turn) * 8; j < std::min(before.ny(), static_cast<int>(turn + 1) * 8); ++j)
      row(j);
  });
  return result;
}

std::string percent_of(double share) {
  return std::to_string(static_cast<int>(std::lround(100 * share))) + " %";
}

}  // namespace
}  // namespace registration

Registration registered(const Surface& after, const Surface& before, const RegistrationOptions& options,
                        Monitor& monitor) {
  using namespace registration;
  require(std::isfinite(options.angle) && options.angle >= 0, "angle", options.angle, "rad",
          "give the greatest turn to either side, e.g. \"5 deg\"; \"360 deg\" is the whole circle");
  if (options.at_most)
    require(std::isfinite(*options.at_most) && *options.at_most > 0, "at_most", *options.at_most, "m",
            "give the greatest shift, above zero");
  const double cell = std::sqrt(before.grid().hx() * before.grid().hy());
  Prepared from = prepared(after, "the after-map", cell), onto = prepared(before, "the before-map", cell);
  const double unit = rms_height(onto.map);
  divide_heights(from.map, unit);
  divide_heights(onto.map, unit);
  const HeightMap from_map = without_spikes(from.map), onto_map = without_spikes(onto.map);

  // Coarse maps of half the cells, and of 256 a side at most.
  const double widest = std::max({from.map.hx, from.map.hy, onto.map.hx, onto.map.hy});
  const double longest =
      std::max({from.map.extent_x(), from.map.extent_y(), onto.map.extent_x(), onto.map.extent_y()});
  const double spacing = std::max(2 * widest, longest / (most_coarse_cells - 1));
  const HeightMap coarse_before = coarser_map(onto_map, spacing),
                  coarse_after = coarser_map(from_map, spacing);
  if (std::min({coarse_after.nx(), coarse_after.ny(), coarse_before.nx(), coarse_before.ny()}) <
          least_cells / 2 ||
      known_count(coarse_after.heights.values()) == 0 || known_count(coarse_before.heights.values()) == 0)
    refuse("the maps have too little in common: one is " + metres(after.grid().size_x) + " x " +
               metres(after.grid().size_y) + " and the other " + metres(before.grid().size_x) + " x " +
               metres(before.grid().size_y),
           "crop the larger one, or measure both with like cells");
  const bool whole_circle = options.angle >= std::numbers::pi;
  CoarseOptions search;
  search.greatest_turn = std::min(options.angle, std::numbers::pi);
  search.greatest_shift = options.at_most ? *options.at_most / cell : std::numeric_limits<double>::infinity();
  search.from_x = 0.5 * (from.map.extent_x() - onto.map.extent_x());
  search.from_y = 0.5 * (from.map.extent_y() - onto.map.extent_y());
  search.step = whole_circle ? degree : 0.75 * degree;
  const std::vector<Candidate> candidates = coarse_candidates(coarse_before, coarse_after, search, monitor);
  const Judged coarse = judged(coarse_before, coarse_after, candidates, search, monitor);

  const SmoothMap before_smooth = smoothed_map(onto_map, widest);
  SmoothMap after_smooth = smoothed_map(from_map, widest);
  const double share = share_that_counts(before_smooth, after_smooth, onto.map, from.map);
  const MapPair maps(before_smooth, std::move(after_smooth), share);
  RefinementOptions fine;
  fine.stride = std::max(
      1,
      static_cast<int>(std::ceil(std::sqrt(static_cast<double>(after.grid().nodes()) / (1 << 19)) - 1e-9)));
  fine.least_overlap = least_overlap;
  fine.most_steps = 60;
  Refined found = refined(maps, coarse.best.pose, fine);
  if (!found.possible)
    refuse("the best placement leaves " + percent_of(found.overlap) +
               " of the smaller map on the other, or no relief there",
           "measure more of the same ground");
  if (found.explained < least_explained || coarse.best.explained < least_explained)
    refuse("the best placement explains " +
               percent_of(std::max(0.0, std::min(found.explained, coarse.best.explained))) +
               " of the heights: the maps do not show the same ground, or it is worn too far",
           "search more angles and longer shifts (`angle`, `at_most`), or take maps of one specimen");
  const double as_good = std::max(clearly_worse * (1 - coarse.best.explained), least_difference);
  if (1 - coarse.moved < as_good)
    refuse(
        "a few cells further the after-map lies as well: the ground has no features along one direction, or "
        "looks the same "
        "when it is turned",
        "measure ground with features of its own in every direction");
  if (1 - coarse.second < as_good)
    refuse("another placement explains the heights as well (" + percent_of(coarse.second) + ", the best " +
               percent_of(coarse.best.explained) + "): the ground repeats itself",
           "narrow the search with `angle` and `at_most`, or measure ground with features of its own");
  const PoseUncertainty u = jackknifed(maps, found, fine);
  if (!u.possible)
    refuse("too little of the maps overlaps to say how sure the placement is",
           "measure more of the same ground");
  // Few features are soon explained by chance; then the tiles do not agree.
  const double radius = 0.5 * std::max(from.map.extent_x(), from.map.extent_y());
  const double loose = std::max({u.pose.x, u.pose.y, u.pose.turn * radius});
  if (found.explained < firmly_explained && loose > 0.25 * widest)
    refuse("the best placement explains " + percent_of(found.explained) +
               " of the heights, and the parts of the map disagree by " + metres(loose * cell) + " about it",
           "measure more ground with features of its own, or narrow the search with `angle` and `at_most`");

  const Plane& plane = found.plane;
  Field heights = laid_on(from.map, onto.map, found.pose, plane, onto.plane, unit, monitor);
  const std::size_t both = [&] {
    std::size_t count = 0;
    for (std::size_t k = 0; k < heights.size(); ++k)
      count += !std::isnan(heights[k]) && !std::isnan(onto.map.heights[k]) ? 1 : 0;
    return count;
  }();
  SurfaceTraits traits;
  traits.material = after.material();
  Registration result{Surface::with_holes(before.grid(), std::move(heights), std::move(traits))};

  const Grid &a = after.grid(), &b = before.grid();
  result.shift_x = found.pose.x * cell + 0.5 * ((b.nx - 1) * b.hx() - (a.nx - 1) * a.hx());
  result.shift_y = found.pose.y * cell + 0.5 * ((b.ny - 1) * b.hy() - (a.ny - 1) * a.hy());
  result.angle = std::remainder(found.pose.turn, 2 * std::numbers::pi);
  // Of the after-map above the before-map: the planes that were taken off, and what was found between.
  const auto [sine, cosine] = elementary::sincos(found.pose.turn);
  const double slope_x = (from.plane.slope_x + plane.slope_x * unit) / cell;
  const double slope_y = (from.plane.slope_y + plane.slope_y * unit) / cell;
  result.tilt_x = cosine * slope_x - sine * slope_y - onto.plane.slope_x / cell;
  result.tilt_y = sine * slope_x + cosine * slope_y - onto.plane.slope_y / cell;
  result.lift = from.plane.height + plane.height * unit - onto.plane.height -
                onto.plane.slope_x * found.pose.x - onto.plane.slope_y * found.pose.y;
  // The uncertainties of the slopes turn as lengths of an ellipse along the axes do.
  const double ux = u.plane.slope_x * unit / cell, uy = u.plane.slope_y * unit / cell;
  result.u = {u.pose.x * cell,
              u.pose.y * cell,
              u.pose.turn,
              elementary::hypot(cosine * ux, sine * uy),
              elementary::hypot(sine * ux, cosine * uy),
              u.plane.height * unit};
  result.residual = found.residual * unit;
  result.overlap = static_cast<double>(both) / static_cast<double>(before.measured());
  result.explained = found.explained;
  result.second_best = std::max(0.0, coarse.second);
  return result;
}

}  // namespace asperity
