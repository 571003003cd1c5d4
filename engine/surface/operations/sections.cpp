// SPDX-License-Identifier: GPL-3.0-or-later
// Bilinear interpolation: a section never exceeds the highest node.
#include "engine/surface/operations/sections.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/require.hpp"
#include "engine/surface/operations/missing_points.hpp"

namespace asperity {

namespace {

constexpr double most_profile_points = 16777216;

int line_number(double wanted, int count, const char* key) {
  if (!(wanted >= 0 && wanted < count && wanted == std::floor(wanted)))
    refuse("there is no " + std::string(key) + " " + format_short(wanted, 17),
           quoted(key) + " runs from 0 to " + std::to_string(count - 1));
  return static_cast<int>(wanted);
}

Profile section(const Surface& surface, double spacing, Array<double> heights, const std::string& what) {
  if (!surface.complete() && known_count(heights) == 0)
    refuse("no point of " + what + " was measured",
           "take another line, or fill the holes first, `surface:filled{ by=\"interpolate\" }`");
  return remade_with(!surface.complete(), spacing, std::move(heights));
}

Profile line(const Surface& surface, LineDirection along, int k) {
  const Field& h = surface.measured_heights();
  const bool row = along == LineDirection::x;
  Array<double> heights(static_cast<std::size_t>(row ? h.nx() : h.ny()));
  for (int n = 0; n < std::ssize(heights); ++n)
    heights[static_cast<std::size_t>(n)] = row ? h(n, k) : h(k, n);
  return section(surface, row ? surface.grid().hx() : surface.grid().hy(), std::move(heights),
                 (row ? "row " : "column ") + std::to_string(k));
}

struct Between {
  int below = 0, above = 0;
  double share = 0;
};

Between between(double place, int n, bool wraps) {
  if (!wraps) {
    place = std::clamp(place, 0.0, n - 1.0);
    const int below = std::min(static_cast<int>(place), std::max(0, n - 2));
    return {below, std::min(below + 1, n - 1), place - below};
  }
  place -= std::floor(place / n) * n;
  const int below = static_cast<int>(place) % n;
  return {below, (below + 1) % n, place - std::floor(place)};
}

// The clamp keeps a flat exactly flat.
double mixed(double a, double b, double share) {
  if (std::isnan(a) || std::isnan(b)) return share == 0 ? a : share == 1 ? b : std::nan("");
  return std::clamp((1 - share) * a + share * b, std::min(a, b), std::max(a, b));
}

}  // namespace

Profile profile_row(const Surface& surface, double j) {
  return line(surface, LineDirection::x, line_number(j, surface.grid().ny, "row"));
}

Profile profile_column(const Surface& surface, double i) {
  return line(surface, LineDirection::y, line_number(i, surface.grid().nx, "column"));
}

std::vector<Profile> profiles(const Surface& surface, LineDirection along) {
  std::vector<Profile> result;
  const int count = along == LineDirection::x ? surface.grid().ny : surface.grid().nx;
  result.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) result.push_back(line(surface, along, k));
  return result;
}

double height_between(const Surface& surface, Point point) {
  const Grid& g = surface.grid();
  const bool wraps = surface.traits().periodic;
  const Between x = between(point.x / g.hx(), g.nx, wraps), y = between(point.y / g.hy(), g.ny, wraps);
  const Field& h = surface.measured_heights();
  const double low = mixed(h(x.below, y.below), h(x.above, y.below), x.share);
  const double high = mixed(h(x.below, y.above), h(x.above, y.above), x.share);
  return mixed(low, high, y.share);
}

Profile profile_between(const Surface& surface, Point from, Point to, std::optional<double> points) {
  const Grid& g = surface.grid();
  for (const double coordinate : {from.x, from.y, to.x, to.y})
    if (!std::isfinite(coordinate))
      refuse("an end of the line is at " + format_short(coordinate) + " m",
             "give finite coordinates in `from` and `to`");
  const double length = elementary::hypot(to.x - from.x, to.y - from.y);
  if (!(length > 0)) refuse("`from` and `to` are the same point", "give the two ends of a line");
  // Rounding must not turn n cells into n + 1.
  const double count = points.value_or(std::ceil(length / std::min(g.hx(), g.hy()) - 1e-9) + 1);
  if (!(count >= 2 && count <= most_profile_points && count == std::floor(count)))
    refuse("`points` is " + format_short(count, 10),
           "give a whole number from 2 to " + format_short(most_profile_points, 10));
  if (!surface.traits().periodic) {
    const double slack = 1e-9;
    for (const Point& end : {from, to}) {
      const double u = end.x / g.hx(), v = end.y / g.hy();
      if (u < -slack || u > g.nx - 1 + slack || v < -slack || v > g.ny - 1 + slack)
        refuse("the line ends at (" + format_short(end.x) + ", " + format_short(end.y) +
                   ") m, outside a surface that is not periodic",
               "its nodes reach from (0, 0) to (" + format_short((g.nx - 1) * g.hx()) + ", " +
                   format_short((g.ny - 1) * g.hy()) + ") m");
    }
  }
  const auto n = static_cast<std::size_t>(count);
  Array<double> heights(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(n - 1);
    heights[k] = height_between(surface, {(1 - t) * from.x + t * to.x, (1 - t) * from.y + t * to.y});
  }
  return section(surface, length / static_cast<double>(n - 1), std::move(heights), "this line");
}

}  // namespace asperity
