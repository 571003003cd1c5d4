// SPDX-License-Identifier: GPL-3.0-or-later
// Power spectral density of heights z = Σ_q z_q exp(i q·x), in the convention of Persson and of
// Jacobs, Junge & Pastewka (2017), "Quantitative characterization of surface topography using
// spectral analysis":
//
//   surface: C(q) = area · |z_q|²,    Rq² = (1/2π)² ∫∫ C d²q = (1/2π) ∫ q C dq for isotropic C, in m⁴;
//   profile: C(q) = length · |z_q|²,  Rq² = (1/2π) ∫ C dq over waves of either sign, in m³;
//
// averaged over the modes of each shell of |q|, so that Σ count·C / area (length) is Rq² exactly.
// The mean is left out; nothing else is removed: level the surface first if it is tilted. Points that were
// not measured are set to the mean of the others, and the spectrum says how many were measured: they hold no
// power, and their rims add some of short waves.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// A Hann window, sin² towards every rim, keeps the jump between opposite rims out of the spectrum.
// Heights are taken about their weighted mean and the spectrum is divided by mean window², so that
// what is uniform along the surface keeps its level; waves of the order of the size are smeared.
enum class Window {
  automatic,  // none for a periodic surface or a closed outline, otherwise hann
  none,
  hann,
};

struct SpectrumOptions {
  Window window = Window::automatic;
  // 0: a shell per multiple of the fundamental 2π/longest side. Otherwise that many shells of equal
  // ratio from the fundamental to the corner of the grid.
  int bins = 0;
};

// One entry a shell that holds a mode, by rising q.
struct Spectrum {
  std::vector<double> q;                 // rad/m, mean over the modes of the shell
  std::vector<double> C;                 // m⁴ of a surface, m³ of a profile
  std::vector<std::int64_t> count;       // modes of the shell, waves of both signs counted
  double rms_height = 0;                 // m, √Σ|z_q|²: Rq without a window
  double rms_slope = 0;                  // √Σ q²|z_q|², the slope of the interpolating waves
  Window window = Window::none;          // the one used
  std::optional<std::int64_t> measured;  // points; absent where every point was measured
};

// Two copies of the grid, one transform; thread-safe, same bits for any number of threads. One node
// or equal heights give no shells or zeros. Throws Error{bad_value} naming `bins` below 0.
Spectrum spectrum(const Surface& surface, const SpectrumOptions& options = {});
Spectrum spectrum(const Profile& profile, const SpectrumOptions& options = {});

}  // namespace asperity
