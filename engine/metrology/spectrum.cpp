// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "engine/core/fourier/fourier.hpp"
#include "engine/metrology/blocked_sums.hpp"
#include "engine/surface/operations/missing_points.hpp"

namespace asperity {

namespace {

Array<double> window_samples(Window window, int n) {
  return window == Window::hann && n > 1 ? hann_window(n) : Array<double>(static_cast<std::size_t>(n), 1.0);
}

double mean_square(std::span<const double> samples) {
  return blocked_sums<1>(samples.size(),
                         [&](std::size_t k) { return std::array{samples[k] * samples[k]}; })[0] /
         static_cast<double>(samples.size());
}

double known_weighted_mean(const Field& z, std::span<const double> wx, std::span<const double> wy) {
  double result = 0;
  for (int pass = 0; pass < 2; ++pass) {
    Array<double> sums(wy.size()), weights(wy.size());
    for (std::size_t j = 0; j < wy.size(); ++j) {
      const std::span<const double> heights = z.row(static_cast<int>(j));
      Array<double> terms(wx.size()), shares(wx.size());
      for (std::size_t i = 0; i < wx.size(); ++i) {
        if (std::isnan(heights[i])) continue;
        shares[i] = wx[i];
        terms[i] = wx[i] * (heights[i] - result);
      }
      sums[j] = wy[j] * block_sum(terms);
      weights[j] = wy[j] * block_sum(shares);
    }
    result += block_sum(sums) / block_sum(weights);
  }
  return result;
}

// Two passes, against large offsets.
double weighted_mean(const Field& z, std::span<const double> wx, std::span<const double> wy) {
  double result = 0;
  for (int pass = 0; pass < 2; ++pass) {
    Array<double> sums(wy.size());
    parallel_for(z.ny(), [&](std::int64_t row) {
      const auto j = static_cast<std::size_t>(row);
      const std::span<const double> heights = z.row(static_cast<int>(row));
      Array<double> terms(wx.size());
      for (std::size_t i = 0; i < wx.size(); ++i) terms[i] = wx[i] * (heights[i] - result);
      sums[j] = wy[j] * block_sum(terms);
    });
    result += block_sum(sums) / (block_sum(wx) * block_sum(wy));
  }
  return result;
}

struct Shells {
  double fundamental = 0, corner = 0;  // rad/m
  int bins = 0;
  std::size_t of(double q) const {
    if (bins == 0) return static_cast<std::size_t>(std::floor(q / fundamental + 0.5));
    const double place =
        corner > fundamental ? elementary::log(q / fundamental) / elementary::log(corner / fundamental) : 0;
    return static_cast<std::size_t>(std::clamp(std::floor(bins * place), 0.0, bins - 1.0));
  }
  std::size_t size() const { return bins > 0 ? static_cast<std::size_t>(bins) : of(corner) + 2; }
};

Shells shells_of(const Grid& grid, int bins) {
  const double x = grid.nx > 1 ? 2 * pi / grid.size_x : 0, y = grid.ny > 1 ? 2 * pi / grid.size_y : 0;
  const double least = x > 0 && y > 0 ? std::min(x, y) : std::max(x, y);
  return {least, elementary::hypot(x * (grid.nx / 2), y * (grid.ny / 2)), bins};
}

// Subtracts the mean, multiplies by the window, and divides by a power of two against overflow: returns the
// exponent.
int apply_window(Field& z, std::span<const double> wx, std::span<const double> wy, bool holes) {
  const Range r = holes ? known_range(z.values()) : range(z.values());
  if (r.min == r.max) {
    std::fill(z.values().begin(), z.values().end(), 0.0);
  } else {
    const double down = std::ldexp(1.0, -scale_exponent(magnitude(r)));
    for (double& value : z.values()) value *= down;
    const double centre = holes ? known_weighted_mean(z, wx, wy) : weighted_mean(z, wx, wy);
    for (double& value : z.values()) value -= centre;
    if (holes)
      for (double& value : z.values())
        if (std::isnan(value)) value = 0;
  }
  const int coarse = r.min == r.max ? 0 : scale_exponent(magnitude(r));
  const int fine = scale_exponent(magnitude(range(z.values())));
  const double up = std::ldexp(1.0, -fine);
  for (int j = 0; j < z.ny(); ++j)
    for (int i = 0; i < z.nx(); ++i)
      z(i, j) *= up * wx[static_cast<std::size_t>(i)] * wy[static_cast<std::size_t>(j)];
  return coarse + fine;
}

// `measure`: area (surface) or length (profile).
Spectrum measure_spectrum(Field z, const Grid& grid, double measure, Window window, int bins, bool holes) {
  if (bins < 0)
    throw Error(ErrorCode::bad_value, "`bins` of a spectrum is " + std::to_string(bins),
                "give 0 for a shell per mode number, or the number of shells of equal ratio");
  Spectrum result;
  result.window = window;
  if (z.size() < 2) return result;

  const Array<double> wx = window_samples(window, grid.nx), wy = window_samples(window, grid.ny);
  const double window_power = mean_square(wx) * mean_square(wy);
  const int exponent = apply_window(z, wx, wy, holes);
  const HalfSpectrum waves = fourier_forward(z);
  z = Field();
  const Shells shells = shells_of(grid, bins);
  std::vector<double> sum_q(shells.size()), sum_power(shells.size());
  std::vector<std::int64_t> count(shells.size());
  Array<double> height_sums(static_cast<std::size_t>(grid.ny)), slope_sums(height_sums.size());
  const double per_node = 1 / static_cast<double>(grid.nodes());
  for (int b = 0; b < waves.ny(); ++b) {
    const double qy = 2 * pi / grid.size_y * waves.wave_y(b);
    double heights = 0, slopes = 0;
    for (int a = 0; a < waves.bins_x(); ++a) {
      if (a == 0 && b == 0) continue;
      const double qx = 2 * pi / grid.size_x * a;
      const double q2 = qx * qx + qy * qy, q = std::sqrt(q2);
      // Bins represent a wave and its conjugate, except the self-conjugate ends.
      const int twins = a == 0 || 2 * a == waves.nx() ? 1 : 2;
      const double power = twins * std::norm(waves(a, b) * per_node) / window_power;
      heights += power;
      slopes += q2 * power;
      const std::size_t k = shells.of(q);
      sum_q[k] += twins * q;
      sum_power[k] += power;
      count[k] += twins;
    }
    height_sums[static_cast<std::size_t>(b)] = heights;
    slope_sums[static_cast<std::size_t>(b)] = slopes;
  }
  result.rms_height = std::ldexp(std::sqrt(block_sum(height_sums)), exponent);
  result.rms_slope = std::ldexp(std::sqrt(block_sum(slope_sums)), exponent);
  for (std::size_t k = 0; k < count.size(); ++k) {
    if (count[k] == 0) continue;
    const auto modes = static_cast<double>(count[k]);
    result.q.push_back(sum_q[k] / modes);
    result.C.push_back(std::ldexp(measure * (sum_power[k] / modes), 2 * exponent));
    result.count.push_back(count[k]);
  }
  return result;
}

Window chosen(Window asked, bool periodic) {
  if (asked != Window::automatic) return asked;
  return periodic ? Window::none : Window::hann;
}

}  // namespace

Array<double> hann_window(int n) {
  Array<double> samples(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    const double s = elementary::sin(pi * (i + 0.5) / n);
    samples[static_cast<std::size_t>(i)] = s * s;
  }
  return samples;
}

Spectrum spectrum(const Surface& surface, const SpectrumOptions& options) {
  Spectrum result =
      measure_spectrum(surface.measured_heights(), surface.grid(), surface.grid().area(),
                       chosen(options.window, surface.traits().periodic), options.bins, !surface.complete());
  if (!surface.complete()) result.measured = static_cast<std::int64_t>(surface.measured());
  return result;
}

Spectrum spectrum(const Profile& profile, const SpectrumOptions& options) {
  const Grid grid{profile.size(), 1, profile.length(), profile.spacing()};
  Spectrum result =
      measure_spectrum(line_of(profile), grid, profile.length(), chosen(options.window, profile.closed()),
                       options.bins, !profile.complete());
  if (!profile.complete()) result.measured = static_cast<std::int64_t>(profile.measured());
  return result;
}

}  // namespace asperity
