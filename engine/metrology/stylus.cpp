// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/stylus.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/require.hpp"
#include "engine/metrology/roughness.hpp"
#include "engine/surface/operations/missing_points.hpp"
#include "engine/surface/parallel_rows.hpp"

namespace asperity {

// On a bilinear patch the tip touches a node, an edge (closed form) or the inside (a saddle). For twist · R <
// 1 the problem is concave and Newton's method finds the maximum; otherwise we use ten starts.

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

// At most one period.
Nodes nodes_within(double place, double reach, int n, bool wraps) {
  if (wraps) reach = std::min(reach, 0.5 * n);
  double from = std::floor(place - reach), to = std::floor(place + reach) + 1;
  if (!wraps) {
    from = std::max(from, 0.0);
    to = std::min(to, n - 1.0);
  }
  return {static_cast<std::int64_t>(from), static_cast<std::int64_t>(to)};
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

  // At distance `aside` from the axis; ends count as nodes.
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

  double rest(double slope, double aside) const {
    return std::sqrt(std::max(radius_ * radius_ - aside * aside, 0.0)) * slope / std::sqrt(1 + slope * slope);
  }

  // Never lowers the height.
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

// `sign` -1: erosion, -dilation(-z).
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
      const std::span<const double> row = z.row(wrapped_index(from, g.ny));
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
  for_each_row_reported(g.ny, nx + 2 * static_cast<std::size_t>(rx), monitor, what, one_row);
  return result;
}

Surface with_heights(const Surface& surface, Field heights) {
  SurfaceTraits traits = surface.traits();
  traits.aliased_share.reset();
  return Surface(surface.grid(), std::move(heights), std::move(traits));
}

constexpr double same = 1e-9;  // relative tolerance

double spacing_of(const StylusOptions& o) {
  require_positive("spacing", o.spacing);
  require_positive("speed", o.speed);
  require_positive("rate", o.rate);
  if (o.speed && !o.rate && !o.spacing)
    refuse("`speed` is given without `rate`, so the distance between samples is not known",
           "give `rate`, such as \"100 Hz\", or `spacing`");
  if (!o.speed || !o.rate) return o.spacing.value_or(stylus_spacing);
  const double travelled = *o.speed / *o.rate;
  if (!(std::isfinite(travelled) && travelled > 0))
    refuse("`speed`/`rate` is " + format_short(travelled) + " m",
           "give a speed and a rate that make a spacing");
  if (!o.spacing) return travelled;
  if (std::abs(*o.spacing - travelled) > same * travelled)
    refuse("`spacing` is " + metres(*o.spacing) + ", and `speed`/`rate` is " + metres(travelled),
           "give two of the three, or three that agree");
  return *o.spacing;
}

std::int64_t whole_spacings(double length, double spacing) {
  return static_cast<std::int64_t>(std::floor(length / spacing * (1 + same)));
}

double ratio(double with, double without) { return with == without ? 1 : with / without; }

// The tolerance admits the diagonal.
std::optional<Range> fitting_angles(double length, double width, double height) {
  const double low = length > width ? elementary::acos(width / length) : 0;
  const double high = length > height ? elementary::asin(height / length) : 0.5 * std::numbers::pi;
  if (low > high + same) return {};
  return Range{.min = low, .max = std::max(low, high)};
}

}  // namespace

SphericalTip::SphericalTip(const Surface& surface, double radius)
    : surface_(surface), exponent_(0), top_(surface.height_range().max) {
  radius_ = std::frexp(checked_radius(radius), &exponent_);
  if (radius > 0 && !surface.complete())
    refuse(std::to_string(surface.grid().nodes() - surface.measured()) + " of the " +
               std::to_string(surface.grid().nodes()) +
               " points of the surface were not measured, and a tip may rest on any of them",
           "fill them first, `surface:filled{ by=\"interpolate\" }`, or give `tip` = 0, whose traces keep "
           "the holes");
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
    const std::span<const double> here = z.row(wrapped_index(j, g.ny));
    const std::span<const double> above = z.row(last_row ? static_cast<int>(j) : wrapped_index(j + 1, g.ny));
    auto i = static_cast<std::size_t>(wrapped_index(columns.from, g.nx));
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

Stylus::Stylus(const StylusOptions& options)
    : tip_(options.tip),
      spacing_(spacing_of(options)),
      length_(options.length),
      speed_(options.speed),
      rate_(options.rate) {
  require_positive("length", length_);
  require(std::isfinite(tip_) && tip_ >= 0, "tip", tip_, "m", "give a finite radius of 0 or more");
  if (!(length_ >= 2 * spacing_ * (1 - same)))
    refuse("`length` is " + metres(length_) + " and `spacing` " + metres(spacing_),
           "give a length of at least two spacings, " + metres(2 * spacing_));
  if (!(length_ / spacing_ <= most_stylus_samples))
    refuse("a trace of " + metres(length_) + " with a sample every " + metres(spacing_) + " has " +
               format_short(length_ / spacing_) + " samples",
           "give a shorter `length` or a wider `spacing`: at most " + std::to_string(most_stylus_samples) +
               " samples");
  if (speed_ && !rate_) rate_ = *speed_ / spacing_;
  if (rate_ && !speed_) speed_ = *rate_ * spacing_;
}

int Stylus::samples() const { return static_cast<int>(whole_spacings(length_, spacing_)); }

std::string Stylus::digest() const {
  Digester digester;
  digester.add("stylus").add(tip_).add(spacing_).add(length_).add(speed_.value_or(0)).add(rate_.value_or(0));
  return digester.hex();
}

std::vector<Traverse> Stylus::lines(const Surface& surface, int count, std::uint64_t seed) const {
  if (count < 1 || count > most_traces)
    refuse("`count` is " + std::to_string(count),
           "give a whole number from 1 to " + std::to_string(most_traces));
  const Grid& g = surface.grid();
  const Stream stream(seed, "stylus");
  std::vector<Traverse> lines(static_cast<std::size_t>(count));
  const bool wraps = surface.traits().periodic;
  const double travel = (samples() - 1) * spacing_;
  const double width = (g.nx - 1) * g.hx(), height = (g.ny - 1) * g.hy();
  const std::optional<Range> angles = fitting_angles(travel, width, height);
  if (!wraps && !angles)
    refuse("a trace of `length` " + metres(length_) +
               " does not fit on a surface that is not periodic, with nodes over " + metres(width) + " x " +
               metres(height),
           elementary::hypot(width, height) >= 2 * spacing_
               ? "give a `length` of at most " + metres(elementary::hypot(width, height)) + ", its diagonal"
               : "give a larger surface");
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const double across = stream.uniform(4 * k), along = stream.uniform(4 * k + 1);
    const double turn = stream.uniform(4 * k + 2);
    if (wraps) {
      lines[k] = {{across * g.size_x, along * g.size_y}, 2 * std::numbers::pi * turn};
      continue;
    }
    // One quarter turn suffices: random bits mirror it.
    const double angle = angles->min + angles->span() * turn;
    const double dx = travel * elementary::cos(angle), dy = travel * elementary::sin(angle);
    const std::uint64_t quarter = stream.below(4 * k + 3, 4);
    const bool back_x = (quarter & 1) != 0, back_y = (quarter & 2) != 0;
    const double x = across * std::max(width - dx, 0.0), y = along * std::max(height - dy, 0.0);
    lines[k] = {{back_x ? x + dx : x, back_y ? y + dy : y},
                elementary::atan2(back_y ? -dy : dy, back_x ? -dx : dx)};
  }
  return lines;
}

Point Stylus::at(const Traverse& line, std::size_t k) const {
  const double way = static_cast<double>(k) * spacing_;
  return {line.start.x + way * elementary::cos(line.angle), line.start.y + way * elementary::sin(line.angle)};
}

Profile Stylus::trace(const Surface& surface, const Traverse& line) const {
  const SphericalTip tip(surface, tip_);
  Array<double> heights(static_cast<std::size_t>(samples()));
  constexpr std::size_t samples_a_block = 256;
  for_each_block(heights.size(), samples_a_block, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) heights[k] = tip.height(at(line, k));
  });
  if (!surface.complete() && known_count(heights) == 0)
    refuse("the trace from (" + metres(line.start.x) + ", " + metres(line.start.y) +
               ") crosses no measured point",
           "take another `seed`, a longer trace, or fill the holes first");
  return remade_with(!surface.complete(), spacing_, std::move(heights));
}

StylusScan Stylus::scan(const Surface& surface, int count, std::uint64_t seed, Monitor& monitor) const {
  StylusScan result;
  result.lines = lines(surface, count, seed);
  double ra[2] = {}, slope[2] = {}, amplitude[2] = {}, lift = 0;
  Task task(monitor, "stylus traces", count);
  for (const Traverse& line : result.lines) {
    Profile felt = trace(surface, line);
    Array<double> below(static_cast<std::size_t>(felt.size())), lifts(below.size());
    for (std::size_t k = 0; k < below.size(); ++k) {
      below[k] = height_between(surface, at(line, k));
      lifts[k] = felt.measured_heights()[k] - below[k];
    }
    lift += known_mean(lifts);
    result.effect.greatest_lift = std::max(result.effect.greatest_lift, known_range(lifts).max);
    const Profile needle = remade_with(!surface.complete(), spacing_, std::move(below));
    for (const int with : {0, 1}) {
      const Roughness r = roughness(with != 0 ? felt : needle);
      ra[with] += r.Ra;
      slope[with] += r.rms_slope;
      amplitude[with] += r.amplitude;
    }
    result.traces.push_back(std::move(felt));
    task.advance();
  }
  result.effect.mean_lift = lift / count;
  result.effect.ra_ratio = ratio(ra[1], ra[0]);
  result.effect.rms_slope_ratio = ratio(slope[1], slope[0]);
  result.effect.amplitude_ratio = ratio(amplitude[1], amplitude[0]);
  return result;
}

}  // namespace asperity
