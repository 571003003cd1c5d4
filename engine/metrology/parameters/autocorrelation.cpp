// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/parameters/autocorrelation.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/fourier/fourier.hpp"
#include "engine/core/fourier/fourier_filter.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/require.hpp"
#include "engine/metrology/blocked_sums.hpp"
#include "engine/metrology/registration/natural_spline.hpp"
#include "engine/surface/operations/missing_points.hpp"

namespace asperity {

namespace {

// Sums of products over all pairs per lag; the padding avoids wrapping.
Field sums_over_pairs(Field padded) {
  HalfSpectrum spectrum = fourier_forward(padded);
  padded = Field();
  const std::span<std::complex<double>> bins = spectrum.bins();
  constexpr std::size_t block = 1 << 14;
  for_each_block(bins.size(), block, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) bins[k] = std::norm(bins[k]);
  });
  return fourier_inverse(std::move(spectrum));
}

double wrapped(const Field& sums, int i, int j) {
  return sums(i < 0 ? i + sums.nx() : i, j < 0 ? j + sums.ny() : j);
}

int mirrored(int k, int last) {
  while (std::abs(k) > last) k = (k > 0 ? 2 : -2) * last - k;
  return k;
}

}  // namespace

Autocorrelation::Autocorrelation(const Surface& surface)
    : lags_x_(surface.grid().nx / 2),
      lags_y_(surface.grid().ny / 2),
      hx_(surface.grid().hx()),
      hy_(surface.grid().hy()),
      half_(2 * lags_x_ + 1, lags_y_ + 1) {
  const Grid& grid = surface.grid();
  const Range r = surface.height_range();
  if (r.span() == 0) refuse("a flat surface has no autocorrelation", "it needs heights that differ");
  if (grid.nx < 2 || grid.ny < 2)
    refuse("there is no autocorrelation of " + std::to_string(grid.nx) + " x " + std::to_string(grid.ny) +
               " cells",
           "it needs at least two cells each way");
  const Field& z = surface.measured_heights();
  const MeasuredValues measured(surface);
  const std::span<const double> known = measured.values();
  const double mean = exact_mean(known, r);
  const double unit = std::ldexp(1.0, -scale_exponent(std::max(r.max - mean, mean - r.min)));
  const double squares = blocked_sums<1>(known.size(),
                                         [&](std::size_t k) {
                                           const double v = (known[k] - mean) * unit;
                                           return std::array{v * v};
                                         })[0] /
                         static_cast<double>(known.size());

  const int width = good_fourier_length(grid.nx + lags_x_), height = good_fourier_length(grid.ny + lags_y_);
  const auto pad = [&](const auto& value) {
    Field padded(width, height);
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i)
        if (const double h = z(i, j); !std::isnan(h)) padded(i, j) = value(h);
    return padded;
  };
  const Field products = sums_over_pairs(pad([&](double h) { return (h - mean) * unit; }));
  const bool holes = !surface.complete();
  const Field pairs = holes ? sums_over_pairs(pad([](double) { return 1.0; })) : Field();
  for (int j = 0; j <= lags_y_; ++j)
    for (int i = -lags_x_; i <= lags_x_; ++i) {
      const double number = holes ? std::round(wrapped(pairs, i, j))
                                  : static_cast<double>(grid.nx - std::abs(i)) * (grid.ny - j);
      half_(i + lags_x_, j) = number > 0 ? wrapped(products, i, j) / number / squares : NAN;
    }
}

double Autocorrelation::operator()(int i, int j) const {
  if (std::abs(i) > lags_x_ || std::abs(j) > lags_y_)
    refuse("the lag (" + std::to_string(i) + ", " + std::to_string(j) + ") is over half the map",
           "lags go to " + std::to_string(lags_x_) + " and " + std::to_string(lags_y_) + " cells");
  return j < 0 ? half_(lags_x_ - i, -j) : half_(lags_x_ + i, j);
}

// Values are mirrored at the largest lags. A margin keeps the natural ends of the spline away.
class Autocorrelation::Spline {
 public:
  explicit Spline(const Autocorrelation& f)
      : lags_x_(f.lags_x_), lags_y_(f.lags_y_), hx_(f.hx_), hy_(f.hy_), spline_(with_margins(f)) {}

  // At (x, y) in m, y >= 0.
  double operator()(double x, double y) const {
    return spline_.at(x / hx_ + lags_x_ + margin, y / hy_ + margin).height;
  }

  struct Ray {
    double length = 0;  // up to the fall or to the last lag
    bool fell = false;
  };
  // From the origin at an angle from 0 to π.
  Ray ray(double angle, double level) const {
    const double dx = elementary::cos(angle), dy = elementary::sin(angle);
    const double to_x = dx == 0 ? INFINITY : lags_x_ * hx_ / std::abs(dx),
                 to_y = dy == 0 ? INFINITY : lags_y_ * hy_ / std::abs(dy);
    const double rim = std::min(to_x, to_y);
    const double step = 0.25 / std::max(std::abs(dx) / hx_, std::abs(dy) / hy_);
    const auto f = [&](double t) { return (*this)(t * dx, t * dy); };
    double before = 0;
    while (before < rim) {
      const double after = std::min(before + step, rim);
      if (f(after) <= level) {
        double low = before, high = after;
        for (int k = 0; k < 60 && low < high; ++k) {
          const double middle = (low + high) / 2;
          if (middle <= low || middle >= high) break;
          (f(middle) <= level ? high : low) = middle;
        }
        return {high, true};
      }
      before = after;
    }
    return {rim, false};
  }

 private:
  static constexpr int margin = 28;
  static Field with_margins(const Autocorrelation& f) {
    Field values(2 * (f.lags_x_ + margin) + 1, f.lags_y_ + 2 * margin + 1);
    for (int j = 0; j < values.ny(); ++j)
      for (int i = 0; i < values.nx(); ++i) {
        const double value = f(mirrored(i - f.lags_x_ - margin, f.lags_x_), mirrored(j - margin, f.lags_y_));
        values(i, j) = std::isnan(value) ? 1 : value;  // no pairs: not fallen
      }
    return values;
  }

  int lags_x_, lags_y_;
  double hx_, hy_;
  registration::NaturalSpline spline_;
};

TextureAspect Autocorrelation::texture(double level) const {
  require(level > 0 && level < 1, "level", level, "", "give a value between 0 and 1; 0.2 is the standard's");
  const Spline f(*this);
  constexpr int rays = 360;
  const auto angle_of = [](double k) { return k * std::numbers::pi / rays; };
  Array<Spline::Ray> ray(rays);
  parallel_for(rays, [&](std::int64_t k) {
    ray[static_cast<std::size_t>(k)] = f.ray(angle_of(static_cast<double>(k)), level);
  });
  TextureAspect result;
  int shortest = -1;
  double longest = 0;
  bool all_fell = true;
  for (int k = 0; k < rays; ++k) {
    const Spline::Ray& r = ray[static_cast<std::size_t>(k)];
    longest = std::max(longest, r.length);
    all_fell = all_fell && r.fell;
    if (r.fell && (shortest < 0 || r.length < ray[static_cast<std::size_t>(shortest)].length)) shortest = k;
  }
  if (shortest < 0) return result;
  const auto turned = [](double place) {
    return place < 0 ? place + rays : place >= rays ? place - rays : place;
  };
  const auto ray_at = [&](double place) { return f.ray(angle_of(turned(place)), level); };
  double best = ray[static_cast<std::size_t>(shortest)].length;
  constexpr int bits = 20;
  const double place = boost::math::tools::brent_find_minima([&](double at) { return ray_at(at).length; },
                                                             shortest - 1.0, shortest + 1.0, bits)
                           .first;
  if (const Spline::Ray between = ray_at(place); between.fell) best = std::min(best, between.length);
  result.Sal = best;
  result.resolved = best >= 3 * std::max(hx_, hy_);
  (all_fell ? result.Str : result.Str_bound) = best / longest;
  return result;
}

}  // namespace asperity
