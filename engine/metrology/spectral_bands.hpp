// SPDX-License-Identifier: GPL-3.0-or-later
// The powers of a profile in bands of wavelengths of ratio √2, whose logarithms the method `psd` of
// fractal_dimension.hpp puts a line through. Power is averaged over a band before the logarithm is
// taken: the mean of logarithms would follow the gaps of a spectrum of lines, which show the window and
// not the profile. The logarithm of a mean of ν independent ordinates of a Gaussian profile (gamma
// distributed, of shape ν) lies ln ν - ψ(ν) too low and scatters by √ψ'(ν) (Bartlett and Kendall 1946),
// with ψ the digamma function; the first is put right, the second tells an empty band from chance.
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

// The bands of n samples, by falling wavelength, from half the length (the length, if `wrap`) to 3 samples;
// none for fewer than 16 samples.
std::vector<SpectralBand> spectral_bands(int n, bool wrap);
// Their wavelengths, in samples: geometric means over the ordinates.
std::vector<double> band_wavelengths(int n, bool wrap);

// ln of the mean periodogram over each band, heights in `unit`, a Hann window unless `wrap`; plus
// `log_mean_deficit`, so that it is right in the mean over Gaussian profiles however few ordinates a band
// has.
void band_log_powers(std::span<const double> heights, double unit, bool wrap, std::span<double> log_powers);

// How many independent ordinates scatter as little in their mean as `ordinates` neighbouring ones: as
// many without a window, fewer under a Hann window, whose square sin⁴ correlates neighbours by
// |r|² = 4/9 and the next but one by 1/36.
double independent_ordinates(int ordinates, bool hann);
// ln ν - ψ(ν) and √ψ'(ν) for ν of 1 or more, whole or not.
double log_mean_deficit(double independent);
double log_mean_scatter(double independent);

// The band that lies farthest below the line, of those that hold less than 1/e of its power by 3.5 standard
// deviations of one Gaussian profile; chance does that to about 1 in 1000 fractional Brownian profiles, and
// to fewer than 1 in 100 of any length. Where lines lie farther apart than the bands, or where a spectrum
// ends or bends as much, there is one. `above_line` holds, for each band of n samples, ln power less the
// line.
std::optional<std::size_t> empty_band(int n, bool wrap, std::span<const double> above_line);

}  // namespace asperity
