// SPDX-License-Identifier: GPL-3.0-or-later
// Power spectral density of heights z = Σ_q z_q exp(i q·x), in the convention of Jacobs, Junge & Pastewka
// (2017), "Quantitative characterization of surface topography using spectral analysis":
//
//   surface: C(q) = area · |z_q|²,    Rq² = (1/2π)² ∫∫ C d²q = (1/2π) ∫ q C dq for isotropic C, in m⁴;
//   profile: C(q) = length · |z_q|²,  Rq² = (1/2π) ∫ C dq over both signs, in m³;
//
// averaged over shells of |q|, so Σ count·C / area (length) = Rq². Only the mean is removed. Holes are set to
// the mean: no power inside, short waves at rims.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// Hann window, sin² towards every rim. Division by mean window² preserves the level; waves near the size are
// smeared.
Array<double> hann_window(int n);
enum class Window {
  automatic,  // periodic surface or closed outline: none; else hann
  none,
  hann,
};

struct SpectrumOptions {
  Window window = Window::automatic;
  // 0: a shell per multiple of 2π/longest side. Else shells of equal ratio.
  int bins = 0;
};

// One entry per non-empty shell, by rising q.
struct Spectrum {
  std::vector<double> q;                 // rad/m, mean over the modes of the shell
  std::vector<double> C;                 // surface: m⁴; profile: m³
  std::vector<std::int64_t> count;       // modes, both signs
  double rms_height = 0;                 // m, √Σ|z_q|²; Rq without a window
  double rms_slope = 0;                  // √Σ q²|z_q|²
  Window window = Window::none;          // the one used
  std::optional<std::int64_t> measured;  // points; absent without holes
};

// Two grid copies, one transform. Thread-safe. One node: no shells; equal heights: zeros. Throws
// Error{bad_value} naming `bins` below 0.
Spectrum spectrum(const Surface& surface, const SpectrumOptions& options = {});
Spectrum spectrum(const Profile& profile, const SpectrumOptions& options = {});

// Powers of a profile in wavelength bands of ratio √2, for the method `psd`. Averages power, not logarithms,
// which follow the gaps of line spectra. For Gaussian profiles, the logarithm of a mean of ν independent
// ordinates is ln ν - ψ(ν) too low (corrected) and scatters by √ψ'(ν) (Bartlett & Kendall 1946; ψ: digamma).

// Ordinates first … last of a periodogram.
struct SpectralBand {
  int first = 0, last = 0;
  int ordinates() const { return last - first + 1; }
};

// Falling wavelengths from n/2 (`wrap`: n) to 3 samples; none for n < 16.
std::vector<SpectralBand> spectral_bands(int n, bool wrap);
// Samples; geometric means over the ordinates.
std::vector<double> band_wavelengths(int n, bool wrap);

// ln of the mean periodogram plus `log_mean_deficit`. Heights in `unit`; Hann window unless `wrap`.
void band_log_powers(std::span<const double> heights, double unit, bool wrap, std::span<double> log_powers);

// Independent ordinates of equal scatter. The Hann window correlates neighbours by |r|² = 4/9, second
// neighbours by 1/36.
double independent_ordinates(int ordinates, bool hann);
// ln ν - ψ(ν) and √ψ'(ν) for real ν >= 1.
double log_mean_deficit(double independent);
double log_mean_scatter(double independent);

// The band farthest below the line, among bands 3.5 standard deviations below 1/e of its power. False alarms:
// 1 in 1000 fractional Brownian profiles, under 1 in 100 at any length. `above_line`: ln power minus the
// line, per band.
std::optional<std::size_t> empty_band(int n, bool wrap, std::span<const double> above_line);

}  // namespace asperity
