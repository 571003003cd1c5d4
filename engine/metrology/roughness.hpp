// SPDX-License-Identifier: GPL-3.0-or-later
// Amplitude and slope statistics of surfaces (ISO 25178-2: Sa, Sq …) and profiles (ISO 21920-2: Ra, Rq …)
// over measured nodes, about the mean. No levelling or filtering.
//
//   Ra = mean |z - mean|          Rq² = mean (z - mean)²         amplitude = peak - valley
//   skewness = mean (z - mean)³ / Rq³                           kurtosis = mean (z - mean)⁴ / Rq⁴
//   rms_slope² = mean (zx² + zy²)
#pragma once

#include <cstdint>
#include <optional>

#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

struct Roughness {
  double Ra = 0;                         // m
  double Rq = 0;                         // m, divided by n, not n - 1
  double amplitude = 0;                  // m, peak to valley
  double skewness = 0;                   // 0 for equal heights
  double kurtosis = 0;                   // 3 for Gaussian heights; 0 for equal heights
  double rms_slope = 0;                  // forward differences, never across the rim
  double peak = 0;                       // m, greatest height as stored
  double valley = 0;                     // m, least height as stored
  double mean = 0;                       // m
  std::optional<std::int64_t> measured;  // points; absent without holes
};

// Slopes use nodes with both differences (i < nx - 1, j < ny - 1); one row: along it; one node: 0. With
// holes, rms_slope² is mean zx² plus mean zy² over measured pairs; NaN without pairs. Cost: 5 passes, memory
// below 1 % of the grid. Thread-safe.
Roughness roughness(const Surface& surface);
// A closed outline has heights r - R; its last step does not count.
Roughness roughness(const Profile& profile);

}  // namespace asperity
