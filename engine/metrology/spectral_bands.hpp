// SPDX-License-Identifier: GPL-3.0-or-later
// Powers of a profile in wavelength bands of ratio √2, for the method `psd`. We average power before taking
// logarithms, since mean logarithms follow the gaps of line spectra. For Gaussian profiles, the logarithm of
// a mean of ν independent ordinates is ln ν - ψ(ν) too low (corrected) and scatters by √ψ'(ν) (Bartlett &
// Kendall 1946; ψ: digamma).
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace asperity {

// Ordinates first … last of a periodogram.
struct SpectralBand {
  int first = 0, last = 0;
  int ordinates() const { return last - first + 1; }
};

// Falling wavelengths from n/2 (`wrap`: n) to 3 samples; none for n < 16.
std::vector<SpectralBand> spectral_bands(int n, bool wrap);
// Samples; geometric means over the ordinates.
std::vector<double> band_wavelengths(int n, bool wrap);

// ln of the mean periodogram plus `log_mean_deficit` (unbiased). Heights in `unit`; Hann window unless
// `wrap`.
void band_log_powers(std::span<const double> heights, double unit, bool wrap, std::span<double> log_powers);

// Number of independent ordinates whose mean scatters equally. The Hann window correlates neighbours by |r|²
// = 4/9, second neighbours by 1/36.
double independent_ordinates(int ordinates, bool hann);
// ln ν - ψ(ν) and √ψ'(ν) for real ν >= 1.
double log_mean_deficit(double independent);
double log_mean_scatter(double independent);

// The band farthest below the line, among bands 3.5 standard deviations below 1/e of its power. False alarms:
// 1 in 1000 fractional Brownian profiles, under 1 in 100 at any length. `above_line`: ln power minus the
// line, per band.
std::optional<std::size_t> empty_band(int n, bool wrap, std::span<const double> above_line);

}  // namespace asperity
