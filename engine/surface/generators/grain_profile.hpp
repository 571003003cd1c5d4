// SPDX-License-Identifier: GPL-3.0-or-later
// Outline of a quasi-spherical fractal grain, Fig. 1 of Hanaor, Gan & Einav (2013):
//   r(t) = R[1 + ε(2(w - min w)/(max w - min w) - 1)], t = 2πi/K,
//   w(t) = Σ_n γ^((D-2)n) [cos φ_n - cos(k_n t + φ_n)], a Weierstrass sum, k_n = floor(3γⁿ + 1/2) < K/2.
// A repeated k_n (γ below about 1.3) is skipped.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"
#include "engine/surface/profile.hpp"

namespace asperity {

struct GrainProfileOptions {
  double radius = 0;       // m, > 0
  double D = 0;            // fractal dimension, 1 < D < 2
  double amplitude = 0.1;  // ε, relative to R, 0 <= ε < 1
  int points = 0;          // K, 7 … 2²⁴
  double gamma = 1.5;      // γ, 1.01 … 1e6
  std::uint64_t seed = 1;  // phases φ_n
};

struct GrainTerm {
  int waves = 0;         // k_n
  double amplitude = 0;  // γ^((D-2)n)
  double phase = 0;      // φ_n, radians
};

// Closed profile of r - R with extremes of exactly ±ε R. O(points log points). Throws Error{bad_value}
// naming an option out of range.
Profile grain_profile(const GrainProfileOptions& options, Monitor& monitor = Monitor::silent());

// The terms of w.
std::vector<GrainTerm> grain_terms(const GrainProfileOptions& options);
// w at every point; heights are w · 2εR/(max w - min w), less a constant.
Array<double> grain_outline(const GrainProfileOptions& options, Monitor& monitor = Monitor::silent());

}  // namespace asperity
