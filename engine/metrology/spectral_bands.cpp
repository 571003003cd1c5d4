// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/spectral_bands.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/fourier/fourier.hpp"
#include "engine/core/memory.hpp"
#include "engine/metrology/spectrum.hpp"

namespace asperity {

namespace {

// Recurrences run to here; the series are exact to 1e-14 beyond.
constexpr double far_out = 16;

// Criterion of empty_band.
constexpr double least_gap = 1, standard_deviations = 3.5;

}  // namespace

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

namespace {

// Cached for the last length.
const Array<double>& cached_hann_window(int n) {
  thread_local Array<double> window;
  if (window.size() == static_cast<std::size_t>(n)) return window;
  return window = hann_window(n);
}

}  // namespace

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
