// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/registration/registration.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/require.hpp"
#include "engine/metrology/registration/height_map.hpp"
#include "engine/metrology/registration/natural_spline.hpp"
#include "engine/metrology/registration/placement.hpp"
#include "engine/surface/operations/holes.hpp"
#include "engine/surface/parallel_rows.hpp"

namespace asperity {

namespace registration {
namespace {

struct Prepared {
  HeightMap map;  // heights: rms of the before-map; lengths: cells
  Plane plane;    // subtracted, m over cells
};

Prepared prepared(const Surface& surface, const char* which, double cell) {
  const Grid& grid = surface.grid();
  if (std::min(grid.nx, grid.ny) < least_cells_of_map)
    refuse(std::string(which) + " has " + std::to_string(grid.nx) + " x " + std::to_string(grid.ny) +
               " cells; fewer than 32 along a side cannot be registered",
           "measure on more cells");
  Prepared result;
  result.map = levelled_map(surface, cell, result.plane);
  // Below the rounding error, no relief remains.
  const double rounding =
      1e-13 * std::max(std::abs(surface.height_range().min), std::abs(surface.height_range().max));
  if (!(rms_height(result.map) > rounding))
    refuse(std::string(which) + " is flat except for its tilt, so it has no definite place",
           "register a rough surface");
  return result;
}

void divide_heights(HeightMap& map, double unit) {
  for (double& value : map.heights.values()) value /= unit;
}

Field laid_on(const HeightMap& after, const HeightMap& before, const Pose& pose, const Plane& plane,
              const Plane& before_plane, double unit, Monitor& monitor) {
  Field filled = after.heights;
  const bool holes = known_count(filled.values()) < filled.size();
  if (holes) fill_harmonic(filled, after.hx, after.hy, monitor);
  const NaturalSpline spline(filled);
  const elementary::SineCosine turned = elementary::sincos(pose.turn);
  const double sine = turned.sine, cosine = turned.cosine;
  Field result(before.nx(), before.ny());
  const auto row = [&](int j) {
    for (int i = 0; i < before.nx(); ++i) {
      const double at_x = before.x(i), at_y = before.y(j);
      const double dx = at_x - pose.x, dy = at_y - pose.y;
      const double x = cosine * dx + sine * dy, y = -sine * dx + cosine * dy;
      double u = x / after.hx + 0.5 * (after.nx() - 1), v = y / after.hy + 0.5 * (after.ny() - 1);
      double& height = result(i, j);
      height = std::numeric_limits<double>::quiet_NaN();
      // Rounding must not exclude nodes on the rim.
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
  for_each_row(before.ny(), row);
  return result;
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
  constexpr double no_wear = 100;  // more wear leaves nothing to register
  const double ratio = rms_height(from_map) / rms_height(onto_map);
  if (ratio > no_wear || ratio < 1 / no_wear)
    refuse("the heights of the after-map are " + format_short(ratio, 3) + " times those of the before-map",
           "take two maps of one specimen, and check the units of both");

  const double at_most = options.at_most.value_or(std::numeric_limits<double>::infinity());
  const Placement placement = find_placement(without_spikes(onto.map), without_spikes(from.map),
                                             {options.angle, at_most / cell, cell}, monitor);
  const Refined& found = placement.found;
  const PoseUncertainty& u = placement.u;

  const Plane& plane = found.plane;
  Field heights = laid_on(from.map, onto.map, found.pose, plane, onto.plane, unit, monitor);
  std::size_t both = 0;
  for (std::size_t k = 0; k < heights.size(); ++k)
    both += !std::isnan(heights[k]) && !std::isnan(onto.map.heights[k]) ? 1 : 0;
  Registration result{Surface::with_holes(before.grid(), std::move(heights), {.material = after.material()})};

  const Grid &a = after.grid(), &b = before.grid();
  result.shift_x = found.pose.x * cell + 0.5 * ((b.nx - 1) * b.hx() - (a.nx - 1) * a.hx());
  result.shift_y = found.pose.y * cell + 0.5 * ((b.ny - 1) * b.hy() - (a.ny - 1) * a.hy());
  result.angle = std::remainder(found.pose.turn, 2 * std::numbers::pi);
  // After-map above before-map: the subtracted planes plus the fitted plane.
  const auto [sine, cosine] = elementary::sincos(found.pose.turn);
  const double slope_x = (from.plane.slope_x + plane.slope_x * unit) / cell;
  const double slope_y = (from.plane.slope_y + plane.slope_y * unit) / cell;
  result.tilt_x = cosine * slope_x - sine * slope_y - onto.plane.slope_x / cell;
  result.tilt_y = sine * slope_x + cosine * slope_y - onto.plane.slope_y / cell;
  result.lift = from.plane.height + plane.height * unit - onto.plane.height -
                onto.plane.slope_x * found.pose.x - onto.plane.slope_y * found.pose.y;
  // Slope uncertainties rotate like the axes of an ellipse.
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
  result.second_best = std::max(0.0, placement.second_best);
  return result;
}

}  // namespace asperity
