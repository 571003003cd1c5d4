// SPDX-License-Identifier: GPL-3.0-or-later
// The fractal dimension D of profiles, 1 (smooth) … 2, from how a statistic M changes with the step s
// (in samples) at which the profile is looked at: least squares of ln M on ln s. For a surface D is
// that of its profiles, one less than the surface's own. H = 2 - D is the Hurst exponent.
//
//   length     M = L/L0 = mean √(1 + (Δz/(s·spacing))²) ~ s^(1-D), eq. (3) of Hanaor, Gan & Einav
//              (2013): points 0, s, 2s, …, the last incomplete step dropped
//   structure  M = mean Δz² over the lag s ~ s^2H, all offsets
//   madogram   M = mean |Δz| over the lag s ~ s^H, all offsets (Gneiting, Ševčíková & Percival 2012)
//   psd        M = periodogram at the wavelength s ~ s^(5-2D): Hann window (none if it wraps),
//              mean powers of bands of ratio √2 from half the length to 3 samples
//              (spectral_bands.hpp)
//   box        M = boxes of side s/(n-1) that the profile enters ~ s^-D, after both its length and
//              its height are scaled to 1; finds too little of every D (dimension_scaling.hpp has how much)
//
// `length` depends on the scale of the heights: see length_ratio.hpp. The others do not.
// Nothing is levelled or filtered first.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

enum class DimensionMethod { length, psd, structure, box, madogram };
enum class Along { x, y, both };

struct FractalDimensionOptions {
  DimensionMethod method = DimensionMethod::length;
  Along along = Along::x;  // which profiles of a surface: rows, columns or all
  // Steps in samples, two or more, from 1 up to under the profile's samples. Empty means 1, 2, 4, 8,
  // 16, as far as two of them fit (`box`: 1, 2, 4, … as far as four fit). `psd` has its own bands
  // and takes none.
  std::vector<int> steps;
  // Steps continue across the rim (periodic surfaces); otherwise closed outlines only.
  std::optional<bool> wrap;
  // `length`: average over all starting points, not only sample 0.
  bool offsets = false;
  // m: radius of the tip that traced the profiles. Steps below its reliability cut-off (scale_dependence.hpp)
  // are then not believed.
  std::optional<double> tip;
  // One line through the statistic averaged over profiles, not the mean of each profile's D.
  bool pooled = false;
};

struct FractalDimension {
  double D = 1;
  // Standard deviation of D over profiles; of one profile, standard error of the fit. Of `box`, the root of
  // its square and that of the bias of box counting.
  double error = 0;
  // The statistic at every step, averaged over profiles (psd: by its logarithm), and the steps
  // (psd: wavelengths) in samples. structure and psd in m², madogram in m, the others plain.
  std::vector<double> lengths, steps;
  double r_squared = 0;                  // of the line through `lengths`
  int profiles = 0;                      // that gave a D
  std::optional<std::int64_t> measured;  // points; absent where every point was measured
  bool resolved = false;                 // D can be believed as far as the method itself can tell
  std::string reason;                    // why not, else empty
};

// `resolved` is false, with a reason, where heights are equal to rounding, fewer than three steps
// (psd: three bands) fit, some profiles are flat, heights repeat, D falls outside 1 … 2 by more than its
// error, where a few jumps make most of the heights, where D runs from step to step or small boxes find the
// profile smooth (dimension_scaling.hpp), where steps are shorter than `tip` can show, for `psd`, where a
// band is empty (spectral_bands.hpp), for `box`, where `structure` with its own steps is not resolved, or,
// for `length`, where the profile is so flat that a Gaussian one of the same slopes would show less than this
// share of D - 1.
inline constexpr double length_share_wanted = 0.9;

// With points that were not measured, `length`, `structure` and `madogram` are means over the steps of which
// both ends were measured; a profile without any at one of the steps gives no D. `psd` and `box` need every
// point and throw Error{bad_value}. Cost O(nodes · steps) (psd: n log n). Memory: steps doubles a profile.
// Same bits for any number of threads; thread-safe. Throws Error{bad_value} naming `steps` or `pooled`.
FractalDimension fractal_dimension(const Surface& surface, const FractalDimensionOptions& options = {});
FractalDimension fractal_dimension(const Profile& profile, const FractalDimensionOptions& options = {});
// Several traces as the profiles of one surface; steps must fit the shortest.
FractalDimension fractal_dimension(std::span<const Profile> profiles,
                                   const FractalDimensionOptions& options = {});

}  // namespace asperity
