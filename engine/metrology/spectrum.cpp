// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/fourier/fourier.hpp"
#include "engine/core/require.hpp"
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

// Two passes, against large offsets.
double weighted_mean(const Field& z, std::span<const double> wx, std::span<const double> wy, bool holes) {
  double result = 0;
  for (int pass = 0; pass < 2; ++pass) {
    Array<double> sums(wy.size()), weights(wy.size());
    parallel_for(z.ny(), [&](std::int64_t row) {
      const auto j = static_cast<std::size_t>(row);
      const std::span<const double> heights = z.row(static_cast<int>(row));
      Array<double> terms(wx.size()), shares(wx.size());
      for (std::size_t i = 0; i < wx.size(); ++i) {
        if (std::isnan(heights[i])) continue;
        shares[i] = wx[i];
        terms[i] = wx[i] * (heights[i] - result);
      }
      sums[j] = wy[j] * block_sum(terms);
      weights[j] = wy[j] * block_sum(shares);
    });
    result += block_sum(sums) / (holes ? block_sum(weights) : block_sum(wx) * block_sum(wy));
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

// Subtracts the mean, multiplies by the window, and divides by a power of two (overflow): returns the
// exponent.
int apply_window(Field& z, std::span<const double> wx, std::span<const double> wy, bool holes) {
  const Range r = holes ? known_range(z.values()) : range(z.values());
  if (r.min == r.max) {
    std::fill(z.values().begin(), z.values().end(), 0.0);
  } else {
    const double down = std::ldexp(1.0, -scale_exponent(magnitude(r)));
    for (double& value : z.values()) value *= down;
    const double centre = weighted_mean(z, wx, wy, holes);
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
    refuse("`bins` of a spectrum is " + std::to_string(bins),
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

// Recurrences run to here; the series are exact to 1e-14 beyond.
constexpr double far_out = 16;

// Criterion of empty_band.
constexpr double least_gap = 1, standard_deviations = 3.5;

// Cached for the last length.
const Array<double>& cached_hann_window(int n) {
  thread_local Array<double> window;
  if (window.size() == static_cast<std::size_t>(n)) return window;
  return window = hann_window(n);
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

// The Hann window leaks the mean into the first ordinate; waves below three samples are aliased.
std::vector<SpectralBand> spectral_bands(int n, bool wrap) {
  std::vector<SpectralBand> result;
  if (n < 16) return result;
  const int end = (n + 2) / 3;
  for (double low = wrap ? 1 : 2; low < end; low *= std::numbers::sqrt2) {
    const int first = static_cast<int>(std::ceil(low));
    const int last = std::min(static_cast<int>(std::ceil(low * std::numbers::sqrt2)), end) - 1;
    if (first <= last) result.push_back({first, last});
  }
  return result;
}

std::vector<double> band_wavelengths(int n, bool wrap) {
  std::vector<double> result;
  for (const SpectralBand& band : spectral_bands(n, wrap)) {
    double sum = 0;
    for (int k = band.first; k <= band.last; ++k) sum += elementary::log(static_cast<double>(k));
    result.push_back(n / elementary::exp(sum / band.ordinates()));
  }
  return result;
}

void band_log_powers(std::span<const double> heights, double unit, bool wrap, std::span<double> log_powers) {
  const auto n = static_cast<int>(heights.size());
  Array<double> samples(heights.begin(), heights.end());
  const double centre = mean(samples);
  const double* const window = wrap ? nullptr : cached_hann_window(n).data();
  double total = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    double& value = samples[i];
    value = (value - centre) / unit * (wrap ? 1 : window[i]);
    total += value * value;
  }
  const Array<std::complex<double>> waves = fourier_forward(samples);
  // Rounding floor of a zero ordinate.
  const double floor = 1e-32 * total * n;
  const std::vector<SpectralBand> bands = spectral_bands(n, wrap);
  for (std::size_t b = 0; b < bands.size(); ++b) {
    double sum = 0;
    for (int k = bands[b].first; k <= bands[b].last; ++k)
      sum += std::norm(waves[static_cast<std::size_t>(k)]);
    const int ordinates = bands[b].ordinates();
    log_powers[b] = elementary::log(std::max(sum / ordinates, floor)) +
                    log_mean_deficit(independent_ordinates(ordinates, !wrap));
  }
}

double independent_ordinates(int ordinates, bool hann) {
  const double n = ordinates;
  if (!hann) return n;
  return n * n / (n + 2 * (4.0 / 9 * (n - 1) + 1.0 / 36 * std::max(n - 2, 0.0)));
}

// Abramowitz and Stegun (1964), 6.3.5 and 6.3.18.
double log_mean_deficit(double independent) {
  double below = 0, v = independent;
  for (; v < far_out; v += 1) below += 1 / v;
  const double r = 1 / (v * v);
  const double digamma =
      elementary::log(v) - 0.5 / v - r * (1.0 / 12 - r * (1.0 / 120 - r * (1.0 / 252 - r / 240))) - below;
  return elementary::log(independent) - digamma;
}

// Abramowitz and Stegun (1964), 6.4.6 and 6.4.12.
double log_mean_scatter(double independent) {
  double below = 0, v = independent;
  for (; v < far_out; v += 1) below += 1 / (v * v);
  const double r = 1 / (v * v);
  return std::sqrt(below + 0.5 * r + (1 + r * (1.0 / 6 - r * (1.0 / 30 - r * (1.0 / 42 - r / 30)))) / v);
}

std::optional<std::size_t> empty_band(int n, bool wrap, std::span<const double> above_line) {
  const std::vector<SpectralBand> bands = spectral_bands(n, wrap);
  std::optional<std::size_t> emptiest;
  for (std::size_t b = 0; b < bands.size(); ++b) {
    const double chance = log_mean_scatter(independent_ordinates(bands[b].ordinates(), !wrap));
    if (above_line[b] < -least_gap - standard_deviations * chance &&
        (!emptiest || above_line[b] < above_line[*emptiest]))
      emptiest = b;
  }
  return emptiest;
}

}  // namespace asperity
