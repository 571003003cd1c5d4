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
#include <vector>

#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// Hann window, sin² towards every rim, on heights about their weighted mean. Division by mean window²
// preserves the level; waves near the size are smeared.
Array<double> hann_window(int n);
enum class Window {
  automatic,  // periodic surface or closed outline: none; else hann
  none,
  hann,
};

struct SpectrumOptions {
  Window window = Window::automatic;
  // 0: a shell per multiple of 2π/longest side. Else shells of equal ratio up to the grid's corner.
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

// Two grid copies, one transform; thread-safe, same bits for any thread count. One node: no shells; equal
// heights: zeros. Throws Error{bad_value} naming `bins` below 0.
Spectrum spectrum(const Surface& surface, const SpectrumOptions& options = {});
Spectrum spectrum(const Profile& profile, const SpectrumOptions& options = {});

}  // namespace asperity
