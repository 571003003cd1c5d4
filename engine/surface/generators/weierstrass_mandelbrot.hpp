// SPDX-License-Identifier: GPL-3.0-or-later
// Weierstrass–Mandelbrot surface, eq. (2) of Hanaor, Gan & Einav (2013), in the form of Yan & Komvopoulos
// (1998):
//   z = L (G/L)^(D−2) √(ln γ/M) Σ_{m=1..M} Σ_{n=0..n_max} γ^((D−3)n)
//       { cos φ_mn − cos[2π γⁿ (x cos(πm/M) + y sin(πm/M))/L + φ_mn] },
// so z = 0 at node (0, 0). Phases are exact (core/exact_phase.hpp). Not periodic. Unresolved
// waves are counted, or left out on request.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "engine/core/monitor.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

enum class WavePhases { seeded, golden, function };
enum class WaveBand {
  all,       // as published; waves past Nyquist alias, nearly white noise
  resolved,  // only waves of at most half a turn per cell
};

struct WeierstrassMandelbrotOptions {
  int nx = 0, ny = 0;  // `cells`, 1 … 65536 a side
  double D = 0;        // fractal dimension, 2 … 3, inclusive
  double span = 1;     // x side in units of L
  double L = 50;       // sample length, m
  double G = 5;        // height scale, m
  double gamma = 1.5;  // ratio of neighbouring wave numbers, > 1
  int M = 10;          // directions
  int n_max = 100;     // last order; n_max·log2 γ ≤ 2048 and n_max ≤ 4096
  std::uint64_t seed = 1;
  WavePhases phases = WavePhases::seeded;
  std::function<double(int m, int n)> phase_function;  // rad; if phases = function
  WaveBand band = WaveBand::all;
  std::optional<Material> material;
};

// φ/2π in [0, 1) of wave (m, n). Seeded: draw n·M + (m−1) of SplitMix64, independent of n_max. Golden:
// k·0.6180339887498949 modulo 1 in integers, k = m·(n_max+1) + n.
double seeded_phase_turns(std::uint64_t seed, int M, int m, int n);
double golden_phase_turns(int n_max, int m, int n);

// Share of variance in orders n > last_resolved, 0 … 1; order n: proportional to γ^(2(D−3)n).
double share_of_variance_beyond(int last_resolved, double D, double gamma, int n_max);

// Node (i, j) is at (i, j)·span·L/nx: square cells, size_x = span·L, size_y = size_x·ny/nx. aliased_share:
// waves beyond half a turn per cell along their own direction; 0 for WaveBand::resolved. Orders that cannot
// change a bit (together under 2⁻⁶⁰ of order 0) are skipped in the sum, not in the share. The recipe keeps
// all waves on other square cells; waves beyond Nyquist alias there. phase_function runs on this thread,
// once per (m, n), n outer and m inner. Cost: sum_of_plane_waves with under half of M·(n_max+1) waves,
// because m and M−m are mirror images. Memory: heights, tables of 32 MiB at most (nx + ny <= 65536), about
// 120 bytes a wave. Thread-safe; same bits for any number of threads. Throws Error{bad_value} naming the
// key, the wave (m, n) of a non-finite phase, or `band` if no wave is resolved.
Surface weierstrass_mandelbrot(const WeierstrassMandelbrotOptions& options,
                               Monitor& monitor = Monitor::silent());

}  // namespace asperity
