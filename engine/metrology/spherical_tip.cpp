// SPDX-License-Identifier: GPL-3.0-or-later
// On a bilinear patch the tip touches a node, an edge (closed form) or the inside (a saddle). All candidates
// are surface points. For twist · R < 1 the problem is concave and Newton's method finds the maximum;
// otherwise we use ten starts.
#include "engine/metrology/spherical_tip.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

double checked_radius(double radius) {
  require(std::isfinite(radius) && radius >= 0, "tip", radius, "m", "give a finite radius of 0 or more");
  return radius;
}

// Rise of a sphere at distance d <= R, without cancellation.
double rise(double radius, double d2) {
  return d2 / (radius + std::sqrt(std::max(radius * radius - d2, 0.0)));
}

double reach_of(double radius, double height) {
  return height >= radius ? radius : std::sqrt(height * (2 * radius - height));
}

struct Nodes {
  std::int64_t from = 0, to = -1;
};

// Nodes of all cells within `reach` cells; at most one period.
Nodes nodes_within(double place, double reach, int n, bool wraps) {
  if (wraps) reach = std::min(reach, 0.5 * n);
  double from = std::floor(place - reach), to = std::floor(place + reach) + 1;
  if (!wraps) {
    from = std::max(from, 0.0);
    to = std::min(to, n - 1.0);
  }
  return {static_cast<std::int64_t>(from), static_cast<std::int64_t>(to)};
}

int wrapped(std::int64_t k, int n) {
  const std::int64_t rest = k % n;
  return static_cast<int>(rest < 0 ? rest + n : rest);
}

// Relative to the tip's axis: lengths in the tip's unit, heights in m.
struct Patch {
  double x = 0, y = 0;    // first node
  double hx = 0, hy = 0;  // 0 at the last node
  double z00 = 0, z10 = 0, z01 = 0, z11 = 0;

  double top() const { return std::max(std::max(z00, z10), std::max(z01, z11)); }
  double nearest_squared() const {
    const double dx = std::clamp(0.0, x, x + hx), dy = std::clamp(0.0, y, y + hy);
    return dx * dx + dy * dy;
  }
  double height(double px, double py) const {
    const double s = (px - x) / hx, t = (py - y) / hy;
    return z00 + (z10 - z00) * s + (z01 - z00) * t + (z11 - z10 - z01 + z00) * s * t;
  }
};

// Maximum resting height over patches.
class Resting {
 public:
  Resting(double radius, int exponent, double height)
      : radius_(radius),
        metre_(std::ldexp(1.0, exponent)),
        unit_(std::ldexp(1.0, -exponent)),
        parabola_(0.5 * metre_ / radius),
        height_(height) {}

  double height() const { return height_; }

  void touch(const Patch& p) {
    if (p.top() <= height_) return;
    const double nearest = p.nearest_squared();
    // The parabola is below the sphere and needs no root.
    if (nearest > radius_ * radius_ || p.top() - parabola_ * nearest <= height_ ||
        p.top() - drop(nearest) <= height_)
      return;
    offer(p.x, p.y, p.z00);
    if (p.hx > 0) touch_edge(p.x, p.hx, p.y, p.z00, p.z10, false);
    if (p.hy > 0) touch_edge(p.y, p.hy, p.x, p.z00, p.z01, true);
    if (p.hx > 0 && p.hy > 0) touch_inside(p);
  }

 private:
  double drop(double d2) const { return rise(radius_, d2) * metre_; }

  void offer(double px, double py, double z) {
    const double d2 = px * px + py * py;
    if (d2 <= radius_ * radius_) height_ = std::max(height_, z - drop(d2));
  }

  // A line at distance `aside` from the axis; ends count as nodes.
  void touch_edge(double start, double length, double aside, double first, double second, bool along_y) {
    if (aside * aside >= radius_ * radius_) return;
    const double at = rest((second - first) * unit_ / length, aside);
    if (!(at > start && at < start + length)) return;
    const double z = first + (second - first) * ((at - start) / length);
    offer(along_y ? aside : at, along_y ? at : aside, z);
  }

  void touch_inside(const Patch& p) {
    const Saddle saddle{(p.z10 - p.z00) * unit_ / p.hx, (p.z01 - p.z00) * unit_ / p.hy,
                        (p.z11 - p.z10 - p.z01 + p.z00) * unit_ / p.hx / p.hy};
    constexpr double gentle = 0.5;
    if (std::abs(saddle.twist) * radius_ < gentle) {
      // Start: contact with the plane through the middle.
      const double mx = saddle.gx + saddle.twist * 0.5 * p.hy, my = saddle.gy + saddle.twist * 0.5 * p.hx;
      const double norm = radius_ / std::sqrt(1 + mx * mx + my * my);
      offer_inside(p, newton(p, saddle, {norm * mx, norm * my}));
      return;
    }
    for (const double s : {1.0 / 6, 0.5, 5.0 / 6})
      for (const double t : {1.0 / 6, 0.5, 5.0 / 6}) climb(p, saddle, {p.x + s * p.hx, p.y + t * p.hy});
    climb(p, saddle, {std::clamp(0.0, p.x, p.x + p.hx), std::clamp(0.0, p.y, p.y + p.hy)});
  }

  struct Saddle {
    double gx, gy, twist;
    double slope_x(const Patch& p, double y) const { return gx + twist * (y - p.y); }
    double slope_y(const Patch& p, double x) const { return gy + twist * (x - p.x); }
  };

  bool within(Point q) const { return q.x * q.x + q.y * q.y < radius_ * radius_; }

  void offer_inside(const Patch& p, Point q) {
    if (q.x > p.x && q.x < p.x + p.hx && q.y > p.y && q.y < p.y + p.hy) offer(q.x, q.y, p.height(q.x, q.y));
  }

  // Contact with a sloping line at distance `aside` from the axis.
  double rest(double slope, double aside) const {
    return std::sqrt(std::max(radius_ * radius_ - aside * aside, 0.0)) * slope / std::sqrt(1 + slope * slope);
  }

  // Contacts along x and y in turn never lower the height.
  void climb(const Patch& p, const Saddle& saddle, Point q) {
    if (!within(q)) return;
    constexpr int most_turns = 30;
    for (int turn = 0; turn < most_turns; ++turn) {
      const Point from = q;
      q.x = std::clamp(rest(saddle.slope_x(p, q.y), q.y), p.x, p.x + p.hx);
      q.y = std::clamp(rest(saddle.slope_y(p, q.x), q.x), p.y, p.y + p.hy);
      if (std::abs(q.x - from.x) + std::abs(q.y - from.y) < 1e-4 * radius_) break;
    }
    offer_inside(p, q);
    offer_inside(p, newton(p, saddle, q));
  }

  // Equal gradients of patch and tip near q.
  Point newton(const Patch& p, const Saddle& saddle, Point q) const {
    constexpr int most_steps = 12;
    for (int step = 0; step < most_steps && saddle.twist != 0; ++step) {
      const double w2 = radius_ * radius_ - q.x * q.x - q.y * q.y;
      if (!(w2 > 0)) break;
      const double w = std::sqrt(w2), w3 = w2 * w;
      const double fx = saddle.slope_x(p, q.y) - q.x / w, fy = saddle.slope_y(p, q.x) - q.y / w;
      const double axx = 1 / w + q.x * q.x / w3, ayy = 1 / w + q.y * q.y / w3;
      const double axy = q.x * q.y / w3 - saddle.twist;
      const double determinant = axx * ayy - axy * axy;
      if (!(determinant > 0)) break;
      const Point d{(ayy * fx - axy * fy) / determinant, (axx * fy - axy * fx) / determinant};
      Point next{q.x + d.x, q.y + d.y};
      for (double share = 0.5; !within(next) && share > 1e-3; share *= 0.5)
        next = {q.x + share * d.x, q.y + share * d.y};
      q = next;
      if (std::abs(d.x) + std::abs(d.y) < 1e-9 * radius_) break;  // height error 1e-18
    }
    return q;
  }

  double radius_, metre_, unit_, parabola_, height_;
};

// Dilation by the nodes; `sign` -1: erosion, -dilation(-z).
Field extremes(const Surface& surface, const Field& z, double sign, double radius, Monitor& monitor,
               const char* what) {
  const Grid& g = surface.grid();
  const bool wraps = surface.traits().periodic;
  const double reach = reach_of(radius, range(z.values()).span());
  const auto half_width = [&](double room, double h, int n) {
    return static_cast<std::int64_t>(std::min(std::floor(room / h), wraps ? n / 2 : n - 1.0));
  };
  const std::int64_t rx = half_width(reach, g.hx(), g.nx), ry = half_width(reach, g.hy(), g.ny);
  const auto nx = static_cast<std::size_t>(g.nx);
  constexpr double nothing = -std::numeric_limits<double>::infinity();
  Field result(g.nx, g.ny, nothing);
  const auto one_row = [&](int j, Array<double>& padded) {
    const std::span<double> out = result.row(j);
    for (std::int64_t dj = -ry; dj <= ry; ++dj) {
      const std::int64_t from = j + dj;
      if (!wraps && (from < 0 || from >= g.ny)) continue;
      const double dy = static_cast<double>(dj) * g.hy();
      const double room = std::sqrt(std::max(reach * reach - dy * dy, 0.0));
      const std::int64_t most = std::min(rx, static_cast<std::int64_t>(room / g.hx()));
      const std::span<const double> row = z.row(wrapped(from, g.ny));
      const auto margin = static_cast<std::size_t>(most);
      for (std::size_t i = 0; i < nx; ++i) padded[margin + i] = sign * row[i];
      for (std::size_t i = 0; i < margin; ++i) {
        padded[i] = wraps ? padded[i + nx] : nothing;
        padded[margin + nx + i] = wraps ? padded[margin + i] : nothing;
      }
      for (std::int64_t di = -most; di <= most; ++di) {
        const double dx = static_cast<double>(di) * g.hx();
        const double drop = rise(radius, dx * dx + dy * dy);
        const double* shifted = padded.data() + (most + di);
        for (std::size_t i = 0; i < nx; ++i) {
          const double candidate = shifted[i] - drop;
          out[i] = candidate > out[i] ? candidate : out[i];
        }
      }
    }
    for (double& value : out) value *= sign;
  };
  constexpr int rows_a_block = 4, rows_a_turn = 256;
  Task task(monitor, what, g.ny);
  for (int first = 0; first < g.ny; first += rows_a_turn) {
    const int rows = std::min(rows_a_turn, g.ny - first);
    parallel_for((rows + rows_a_block - 1) / rows_a_block, [&](std::int64_t block) {
      Array<double> padded(nx + 2 * static_cast<std::size_t>(rx));
      const int begin = static_cast<int>(block) * rows_a_block;
      for (int j = begin; j < std::min(rows, begin + rows_a_block); ++j) one_row(first + j, padded);
    });
    task.advance(rows);
  }
  return result;
}

Surface with_heights(const Surface& surface, Field heights) {
  SurfaceTraits traits = surface.traits();
  traits.aliased_share.reset();
  return Surface(surface.grid(), std::move(heights), std::move(traits));
}

}  // namespace

SphericalTip::SphericalTip(const Surface& surface, double radius)
    : surface_(surface), exponent_(0), top_(surface.height_range().max) {
  radius_ = std::frexp(checked_radius(radius), &exponent_);
  if (radius > 0 && !surface.complete())
    refuse(std::to_string(surface.grid().nodes() - surface.measured()) + " of the " +
               std::to_string(surface.grid().nodes()) +
               " points of the surface were not measured, and a tip may rest on any of them",
           "fill them first, `surface:filled{ by=\"interpolate\" }`, or give `tip` = 0, a needle, whose "
           "traces have holes where they cross those of the surface");
  hx_ = std::ldexp(surface.grid().hx(), -exponent_);
  hy_ = std::ldexp(surface.grid().hy(), -exponent_);
}

double SphericalTip::height(Point point) const {
  const double below = height_between(surface_, point);
  if (radius_ == 0 || top_ <= below) return below;
  const Grid& g = surface_.grid();
  const bool wraps = surface_.traits().periodic;
  double u = point.x / g.hx(), v = point.y / g.hy();
  if (wraps) {
    u -= std::floor(u / g.nx) * g.nx;
    v -= std::floor(v / g.ny) * g.ny;
  }
  Resting resting(radius_, exponent_, below);
  // The reach shrinks as the tip rises.
  const auto reach = [&] { return reach_of(radius_, std::ldexp(top_ - resting.height(), -exponent_)); };
  const Nodes rows = nodes_within(v, reach() / hy_, g.ny, wraps);
  if (rows.from > rows.to) return below;  // outside the surface
  const Field& z = surface_.heights();
  const auto touch_row = [&](std::int64_t j) {
    Patch patch;
    patch.y = (static_cast<double>(j) - v) * hy_;
    const bool last_row = !wraps && j + 1 >= g.ny;
    patch.hy = last_row ? 0 : hy_;
    const double aside = std::clamp(0.0, patch.y, patch.y + patch.hy), far = reach();
    if (std::abs(aside) > far) return;
    const double half_chord = std::sqrt((far - aside) * (far + aside));
    const Nodes columns = nodes_within(u, half_chord / hx_, g.nx, wraps);
    const std::span<const double> here = z.row(wrapped(j, g.ny));
    const std::span<const double> above = z.row(last_row ? static_cast<int>(j) : wrapped(j + 1, g.ny));
    auto i = static_cast<std::size_t>(wrapped(columns.from, g.nx));
    for (std::int64_t k = columns.from; k <= columns.to; ++k) {
      const bool last_column = !wraps && k + 1 >= g.nx;
      const std::size_t next = last_column ? i : (i + 1 == static_cast<std::size_t>(g.nx) ? 0 : i + 1);
      patch.x = (static_cast<double>(k) - u) * hx_;
      patch.hx = last_column ? 0 : hx_;
      patch.z00 = here[i];
      patch.z10 = here[next];
      patch.z01 = above[i];
      patch.z11 = above[next];
      resting.touch(patch);
      i = next;
    }
  };
  // Near rows first: a high tip shortens the reach.
  const auto middle = std::clamp(static_cast<std::int64_t>(std::floor(v)), rows.from, rows.to);
  for (std::int64_t away = 0; away <= std::max(rows.to - middle, middle - rows.from); ++away) {
    if (middle + away <= rows.to) touch_row(middle + away);
    if (away > 0 && middle - away >= rows.from) touch_row(middle - away);
  }
  return resting.height();
}

Surface dilated(const Surface& surface, double radius, Monitor& monitor) {
  if (checked_radius(radius) == 0) return surface;
  return with_heights(surface,
                      extremes(surface, surface.heights(), 1, radius, monitor, "dilation by the tip"));
}

Surface closed(const Surface& surface, double radius, Monitor& monitor) {
  if (checked_radius(radius) == 0) return surface;
  const Field lifted = extremes(surface, surface.heights(), 1, radius, monitor, "dilation by the tip");
  return with_heights(surface, extremes(surface, lifted, -1, radius, monitor, "erosion by the tip"));
}

}  // namespace asperity
