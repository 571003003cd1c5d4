// SPDX-License-Identifier: GPL-3.0-or-later
// Fractal dimension D of profiles, 1 (smooth) … 2, from a least-squares line of ln M over ln s, for a
// statistic M at steps of s samples. Hurst exponent: H = 2 - D.
//
//   length     M = mean √(1 + (Δz/(s·spacing))²) ~ s^(1-D), eq. (3) of Hanaor, Gan & Einav (2013)
//   structure  M = mean Δz² ~ s^2H, all offsets
//   madogram   M = mean |Δz| ~ s^H, all offsets (Gneiting, Ševčíková & Percival 2012)
//   psd        M = power in bands of wavelength s ~ s^(5-2D) (spectrum.hpp)
//   box        M = boxes of side s/(n-1) in the unit square ~ s^-D; underestimates D
//
// Only `length` depends on the scale of heights (profile_statistics.hpp). No levelling or filtering.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/metrology/profile_statistics.hpp"
#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

enum class Along { x, y, both };

struct FractalDimensionOptions {
  DimensionMethod method = DimensionMethod::length;
  Along along = Along::x;  // rows, columns or all
  // In samples, at least two. Default: 1, 2, 4, 8, 16, up to half the profile (`box`: powers of 2 up to a
  // quarter). Not for `psd`.
  std::vector<int> steps;
  // Steps continue across the rim. Default: closed outlines only.
  std::optional<bool> wrap;
  // `length`: average over all starting points, not only sample 0.
  bool offsets = false;
  // m, tip radius; steps below its cut-off (scale_dependence.hpp) leave D unresolved.
  std::optional<double> tip;
  // Fit the averaged statistic instead of averaging D.
  bool pooled = false;
};

struct FractalDimension {
  double D = 1;
  // Standard deviation over profiles (one: standard error); for `box`, with its bias in quadrature.
  double error = 0;
  // Averaged statistic (structure, psd: m²; madogram: m) and steps or wavelengths in samples.
  std::vector<double> lengths, steps;
  double r_squared = 0;
  int profiles = 0;                      // with a D
  std::optional<std::int64_t> measured;  // points; absent without holes
  bool resolved = false;                 // no check failed
  std::string reason;                    // first failed check
};

// `resolved` is false for equal, flat, repeating or jump-dominated heights; fewer than three steps or bands;
// D outside 1 … 2 by more than its error; D changing with the step or smooth small boxes
// (dimension_scaling.hpp); steps below the cut-off of `tip`; an empty band (spectrum.hpp); `box` if
// `structure` is unresolved; `length` if these slopes show less than this share of D - 1.
inline constexpr double length_share_wanted = 0.9;

// With holes, steps need two measured ends; profiles without one at some step give no D; `psd` and `box`
// throw. Cost O(nodes · steps) (psd: n log n). Thread-safe. Throws Error{bad_value} naming `steps` or
// `pooled`.
FractalDimension fractal_dimension(const Surface& surface, const FractalDimensionOptions& options = {});
FractalDimension fractal_dimension(const Profile& profile, const FractalDimensionOptions& options = {});
// Profiles of one surface; steps must fit the shortest.
FractalDimension fractal_dimension(std::span<const Profile> profiles,
                                   const FractalDimensionOptions& options = {});

}  // namespace asperity
