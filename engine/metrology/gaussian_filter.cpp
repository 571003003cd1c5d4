// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/gaussian_filter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/fourier.hpp"
#include "engine/core/text.hpp"
#include "engine/metrology/blocked_sums.hpp"

namespace asperity {

namespace {

constexpr double ln2 = std::numbers::ln2;
// Cut-offs from the middle of the kernel to where it is under 1e-16: exp(-(π²/ln 2) r²).
constexpr double kernel_reach = 1.62;

// Absent where there is nothing to do.
GaussianFilter checked(const GaussianFilter& filter) {
  if (!filter.short_wave && !filter.long_wave)
    throw Error(ErrorCode::bad_value, "a filter was asked for without `short_wave` or `long_wave`",
                "give one or both, as in `short_wave=\"2.5 um\", long_wave=\"0.8 mm\"`");
  if (filter.short_wave && !(std::isfinite(*filter.short_wave) && *filter.short_wave > 0))
    throw Error(ErrorCode::bad_value, "`short_wave` is " + format_short(*filter.short_wave) + " m",
                "give a finite length above zero");
  if (filter.long_wave && !(*filter.long_wave > 0))
    throw Error(ErrorCode::bad_value, "`long_wave` is " + format_short(*filter.long_wave) + " m",
                "give a length above zero");
  if (filter.short_wave && filter.long_wave && !(*filter.short_wave < *filter.long_wave))
    throw Error(ErrorCode::bad_value,
                "`short_wave` " + format_short(*filter.short_wave) + " m is not below `long_wave` " +
                    format_short(*filter.long_wave) + " m",
                "waves between the two are kept, so `short_wave` must be the smaller");
  GaussianFilter result = filter;
  if (result.long_wave && std::isinf(*result.long_wave)) result.long_wave.reset();
  return result;
}

// What is kept of a wave of |q|² = q_squared, (rad/m)².
double kept(const GaussianFilter& filter, double q_squared) {
  const double unit = ln2 * q_squared / (4 * std::numbers::pi * std::numbers::pi);
  double share = 1;
  if (filter.short_wave) share *= std::exp(-unit * *filter.short_wave * *filter.short_wave);
  if (filter.long_wave) share *= -std::expm1(-unit * *filter.long_wave * *filter.long_wave);
  return share;
}

// A length of at least n that transforms fast.
int smooth_length(int n) {
  for (;; ++n) {
    int rest = n;
    for (const int prime : {2, 3, 5, 7})
      while (rest % prime == 0) rest /= prime;
    if (rest == 1) return n;
  }
}

// The mean line of one cut-off over lines of n samples.
class LineFilter {
 public:
  LineFilter(int n, double spacing, double cut_off)
      : reach_(static_cast<int>(std::min<double>(n - 1, std::floor(kernel_reach * (cut_off / spacing))))),
        padded_(smooth_length(n + reach_)) {
    Array<double> kernel(static_cast<std::size_t>(padded_));
    Array<double> cumulative(static_cast<std::size_t>(reach_) + 1);
    double sum = 0;
    for (int k = 0; k <= reach_; ++k) {
      const double r = k * (spacing / cut_off);
      const double weight = std::exp(-(std::numbers::pi * std::numbers::pi / ln2) * r * r);
      kernel[static_cast<std::size_t>(k)] = weight;
      kernel[static_cast<std::size_t>(k == 0 ? 0 : padded_ - k)] = weight;
      cumulative[static_cast<std::size_t>(k)] = sum += weight;
    }
    response_ = fourier_forward(kernel);
    weights_.resize(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i)
      weights_[static_cast<std::size_t>(i)] =
          cumulative[static_cast<std::size_t>(std::min(i, reach_))] +
          cumulative[static_cast<std::size_t>(std::min(n - 1 - i, reach_))] - 1;
  }

  // Whether a line comes back as it went in.
  bool idle() const { return reach_ == 0; }

  // Replaces the samples by their mean line.
  void apply(std::span<double> line) const {
    Array<double> padded(static_cast<std::size_t>(padded_));
    std::copy(line.begin(), line.end(), padded.begin());
    Array<std::complex<double>> spectrum = fourier_forward(padded);
    for (std::size_t k = 0; k < spectrum.size(); ++k) spectrum[k] *= response_[k].real();
    const Array<double> smooth = fourier_inverse(spectrum, padded_);
    for (std::size_t i = 0; i < line.size(); ++i) line[i] = smooth[i] / weights_[i];
  }

 private:
  int reach_, padded_;
  Array<std::complex<double>> response_;
  Array<double> weights_;
};

void filter_rows(Field& z, const LineFilter& filter) {
  constexpr int rows_per_turn = 8;
  if (filter.idle()) return;
  parallel_for((z.ny() + rows_per_turn - 1) / rows_per_turn, [&](std::int64_t turn) {
    const int first = static_cast<int>(turn) * rows_per_turn;
    for (int j = first; j < std::min(z.ny(), first + rows_per_turn); ++j) filter.apply(z.row(j));
  });
}

void filter_columns(Field& z, const LineFilter& filter) {
  constexpr int columns_per_turn = 16;
  if (filter.idle()) return;
  parallel_for((z.nx() + columns_per_turn - 1) / columns_per_turn, [&](std::int64_t turn) {
    const int first = static_cast<int>(turn) * columns_per_turn;
    const int width = std::min(columns_per_turn, z.nx() - first);
    Field columns(z.ny(), width);
    for (int j = 0; j < z.ny(); ++j)
      for (int c = 0; c < width; ++c) columns(j, c) = z(first + c, j);
    for (int c = 0; c < width; ++c) filter.apply(columns.row(c));
    for (int j = 0; j < z.ny(); ++j)
      for (int c = 0; c < width; ++c) z(first + c, j) = columns(j, c);
  });
}

void keep_mean_surface(Field& z, const Grid& grid, double cut_off) {
  filter_rows(z, LineFilter(grid.nx, grid.hx(), cut_off));
  filter_columns(z, LineFilter(grid.ny, grid.hy(), cut_off));
}

void filter_with_rims(Field& z, const Grid& grid, const GaussianFilter& filter) {
  if (filter.short_wave) keep_mean_surface(z, grid, *filter.short_wave);
  if (!filter.long_wave) return;
  Field smooth = z;
  keep_mean_surface(smooth, grid, *filter.long_wave);
  for (std::size_t k = 0; k < z.size(); ++k) z[k] -= smooth[k];
}

Field filter_periodic(Field z, const Grid& grid, const GaussianFilter& filter) {
  HalfSpectrum spectrum = fourier_forward(z);
  z = Field();
  const double unit_x = 2 * std::numbers::pi / grid.size_x, unit_y = 2 * std::numbers::pi / grid.size_y;
  parallel_for(spectrum.ny(), [&](std::int64_t row) {
    const int b = static_cast<int>(row);
    const double qy = unit_y * spectrum.wave_y(b);
    for (int a = 0; a < spectrum.bins_x(); ++a) {
      const double qx = unit_x * a;
      spectrum(a, b) *= kept(filter, qx * qx + qy * qy);
    }
  });
  return fourier_inverse(std::move(spectrum));
}

// The mean goes round the transforms: it would cost the roughness its digits.
Field filtered(Field z, const Grid& grid, bool periodic, const GaussianFilter& filter) {
  const double mean = exact_mean(z.values(), range(z.values()));
  for (double& value : z.values()) value -= mean;
  if (periodic)
    z = filter_periodic(std::move(z), grid, filter);
  else
    filter_with_rims(z, grid, filter);
  if (!filter.long_wave)
    for (double& value : z.values()) value += mean;
  return z;
}

}  // namespace

double gaussian_transmission(double cut_off, double wavelength) {
  const double ratio = cut_off / wavelength;
  return std::exp2(-ratio * ratio);
}

Surface gaussian_filtered(const Surface& surface, const GaussianFilter& filter) {
  const GaussianFilter needed = checked(filter);
  if (!needed.short_wave && !needed.long_wave) return surface;
  SurfaceTraits traits = surface.traits();
  traits.aliased_share.reset();
  return Surface(surface.grid(), filtered(surface.heights(), surface.grid(), traits.periodic, needed),
                 std::move(traits));
}

Profile gaussian_filtered(const Profile& profile, const GaussianFilter& filter) {
  const GaussianFilter needed = checked(filter);
  if (!needed.short_wave && !needed.long_wave) return profile;
  Field z(profile.size(), 1);
  std::copy(profile.heights().begin(), profile.heights().end(), z.values().begin());
  const Grid grid{profile.size(), 1, profile.length(), profile.spacing()};
  z = filtered(std::move(z), grid, profile.closed(), needed);
  return Profile(profile.spacing(), Array<double>(z.values().begin(), z.values().end()),
                 profile.closed_radius());
}

}  // namespace asperity
