// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/parameters/autocorrelation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/fourier/fourier.hpp"
#include "engine/core/fourier/fourier_filter.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/require.hpp"
#include "engine/metrology/blocked_sums.hpp"
#include "engine/surface/operations/missing_points.hpp"

namespace asperity {

namespace {

// Sums of products over all pairs per lag; the padding avoids wrapping.
Field sums_over_pairs(Field padded) {
  HalfSpectrum spectrum = fourier_forward(padded);
  padded = Field();
  const std::span<std::complex<double>> bins = spectrum.bins();
  constexpr std::size_t block = 1 << 14;
  parallel_for(static_cast<std::int64_t>((bins.size() + block - 1) / block), [&](std::int64_t turn) {
    const std::size_t first = static_cast<std::size_t>(turn) * block;
    for (std::size_t k = first; k < std::min(bins.size(), first + block); ++k) bins[k] = std::norm(bins[k]);
  });
  return fourier_inverse(std::move(spectrum));
}

double wrapped(const Field& sums, int i, int j) {
  return sums(i < 0 ? i + sums.nx() : i, j < 0 ? j + sums.ny() : j);
}

// Cubic B-spline coefficients in place, values mirrored at both ends, `stride` apart, `lanes` neighbours at
// once.
void to_spline(double* values, int count, std::size_t stride, std::size_t lanes) {
  if (count == 1) return;
  const double pole = std::sqrt(3.0) - 2;
  const auto at = [=](int k) { return values + static_cast<std::size_t>(k) * stride; };
  // Causal start: sum over mirrored values, cut below rounding.
  const int reach = std::min(count - 1, 40), period = 2 * (count - 1);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    double sum = 0, power = 1;
    if (reach < count - 1) {
      for (int k = 0; k <= reach; ++k, power *= pole) sum += power * at(k)[lane];
    } else {  // whole period
      double last = 1;
      for (int k = 0; k < period; ++k, power *= pole)
        sum += power * at(k < count ? k : period - k)[lane], last = power * pole;
      sum /= 1 - last;
    }
    at(0)[lane] = sum;
  }
  for (int k = 1; k < count; ++k)
    for (std::size_t lane = 0; lane < lanes; ++lane) at(k)[lane] += pole * at(k - 1)[lane];
  for (std::size_t lane = 0; lane < lanes; ++lane)
    at(count - 1)[lane] = pole / (pole * pole - 1) * (at(count - 1)[lane] + pole * at(count - 2)[lane]);
  for (int k = count - 2; k >= 0; --k)
    for (std::size_t lane = 0; lane < lanes; ++lane) at(k)[lane] = pole * (at(k + 1)[lane] - at(k)[lane]);
  for (int k = 0; k < count; ++k)
    for (std::size_t lane = 0; lane < lanes; ++lane) at(k)[lane] *= 6;
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
  if (r.span() == 0)
    refuse("the autocorrelation of a flat surface was asked for", "it needs heights that differ");
  if (grid.nx < 2 || grid.ny < 2)
    refuse("the autocorrelation of a surface of " + std::to_string(grid.nx) + " x " +
               std::to_string(grid.ny) + " cells was asked for",
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

// Rows from lag -40 on suffice: farther rows change the spline below rounding.
class Autocorrelation::Spline {
 public:
  explicit Spline(const Autocorrelation& f)
      : below_(std::min(f.lags_y_, 40)),
        lags_x_(f.lags_x_),
        lags_y_(f.lags_y_),
        hx_(f.hx_),
        hy_(f.hy_),
        coefficients_(2 * f.lags_x_ + 1, f.lags_y_ + 1 + below_) {
    for (int j = -below_; j <= lags_y_; ++j)
      for (int i = -lags_x_; i <= lags_x_; ++i) {
        const double value = f(i, j);
        coefficients_(i + lags_x_, j + below_) = std::isnan(value) ? 1 : value;  // no pairs: not fallen
      }
    const auto stride = static_cast<std::size_t>(coefficients_.nx());
    parallel_for(coefficients_.ny(), [&](std::int64_t j) {
      to_spline(coefficients_.row(static_cast<int>(j)).data(), coefficients_.nx(), 1, 1);
    });
    constexpr std::size_t lanes = 64;
    parallel_for(static_cast<std::int64_t>((stride + lanes - 1) / lanes), [&](std::int64_t turn) {
      const std::size_t first = static_cast<std::size_t>(turn) * lanes;
      to_spline(coefficients_.data() + first, coefficients_.ny(), stride, std::min(lanes, stride - first));
    });
  }

  // At (x, y) in m, y >= 0.
  double operator()(double x, double y) const {
    const double u = x / hx_ + lags_x_, v = y / hy_ + below_;
    const int i = std::clamp(static_cast<int>(std::floor(u)), 0, coefficients_.nx() - 1),
              j = std::clamp(static_cast<int>(std::floor(v)), 0, coefficients_.ny() - 1);
    double wx[4], wy[4];
    weights(u - i, wx);
    weights(v - j, wy);
    double sum = 0;
    for (int b = 0; b < 4; ++b) {
      const std::span<const double> row = coefficients_.row(mirrored(j + b - 1, coefficients_.ny()));
      double along = 0;
      for (int a = 0; a < 4; ++a)
        along += wx[a] * row[static_cast<std::size_t>(mirrored(i + a - 1, coefficients_.nx()))];
      sum += wy[b] * along;
    }
    return sum;
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
  static void weights(double t, double (&w)[4]) {
    const double s = 1 - t;
    w[0] = s * s * s / 6;
    w[1] = (4 - 6 * t * t + 3 * t * t * t) / 6;
    w[2] = (4 - 6 * s * s + 3 * s * s * s) / 6;
    w[3] = t * t * t / 6;
  }
  static int mirrored(int k, int n) {
    if (n == 1) return 0;
    k = std::abs(k);
    return k < n ? k : 2 * (n - 1) - k;
  }

  int below_, lags_x_, lags_y_;
  double hx_, hy_;
  Field coefficients_;
};

TextureAspect Autocorrelation::texture(double level) const {
  require(level > 0 && level < 1, "level", level, "",
          "give what f is to fall to, between 0 and 1; 0.2 is the standard's");
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
  // Golden-section search between the neighbours of the shortest ray.
  double low = shortest - 1, high = shortest + 1, best = ray[static_cast<std::size_t>(shortest)].length;
  double best_place = shortest;
  const double golden = (std::sqrt(5.0) - 1) / 2;
  const auto length_at = [&](double place) {
    const double turned = place < 0 ? place + rays : place >= rays ? place - rays : place;
    const Spline::Ray r = f.ray(angle_of(turned), level);
    const double length = r.fell ? r.length : INFINITY;
    if (length < best) best = length, best_place = turned;
    return length;
  };
  double left = high - golden * (high - low), right = low + golden * (high - low);
  double at_left = length_at(left), at_right = length_at(right);
  while (high - low > 1e-3) {
    if (at_left < at_right) {
      high = right, right = left, at_right = at_left;
      left = high - golden * (high - low);
      at_left = length_at(left);
    } else {
      low = left, left = right, at_left = at_right;
      right = low + golden * (high - low);
      at_right = length_at(right);
    }
  }
  result.Sal = best;
  result.shortest_angle = angle_of(best_place);
  result.resolved = best >= 3 * std::max(hx_, hy_);
  (all_fell ? result.Str : result.Str_bound) = best / longest;
  return result;
}

}  // namespace asperity
