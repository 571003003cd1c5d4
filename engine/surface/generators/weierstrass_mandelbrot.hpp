// SPDX-License-Identifier: GPL-3.0-or-later
// The Weierstrass–Mandelbrot surface of Hanaor, Gan & Einav (2013), eq. (2), in the form of Yan &
// Komvopoulos (1998):
//   z = L (G/L)^(D−2) √(ln γ/M) Σ_{m=1..M} Σ_{n=0..n_max} γ^((D−3)n)
//       { cos φ_mn − cos[2π γⁿ (x cos(πm/M) + y sin(πm/M))/L + φ_mn] },
// so z = 0 at node (0, 0). Phases of the argument are exact (core/arithmetic/exact_phase.hpp) and the sum
// over the waves is a matrix product (plane_waves.hpp). The surface is not periodic, and nothing is done
// about waves the grid cannot carry but to count them, or to leave them out when asked.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "engine/core/monitor.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

enum class WavePhases { seeded, golden, function };
enum class WaveBand {
  all,       // every n = 0 … n_max, as published; waves past Nyquist alias and act nearly as white noise
  resolved,  // only waves that turn at most half a turn per cell
};

struct WeierstrassMandelbrotOptions {
  int nx = 0, ny = 0;  // `cells`, 1 … 65536 a side
  double D = 0;        // fractal dimension, 2 … 3, both ends included
  double span = 1;     // length of the x side in units of L
  double L = 50;       // sample length, m
  double G = 5;        // height scale, m
  double gamma = 1.5;  // ratio of neighbouring wave numbers, > 1
  int M = 10;          // directions
  int n_max = 100;     // last order; n_max·log2 γ ≤ 2048 and n_max ≤ 4096
  std::uint64_t seed = 1;
  WavePhases phases = WavePhases::seeded;
  std::function<double(int m, int n)> phase_function;  // rad; read only when phases = function
  WaveBand band = WaveBand::all;
  std::optional<Material> material;
};

// φ/2π in [0, 1) of wave (m, n). Seeded: draw n·M + (m−1) of SplitMix64, so that low orders do not
// change with n_max. Golden: k·0.6180339887498949 modulo 1 in whole numbers, k = m·(n_max+1) + n.
double seeded_phase_turns(std::uint64_t seed, int M, int m, int n);
double golden_phase_turns(int n_max, int m, int n);

// Share of the variance of all waves that lies in orders n > last_resolved; 0 … 1. The variance of
// order n is proportional to γ^(2(D−3)n).
double share_of_variance_beyond(int last_resolved, double D, double gamma, int n_max);

// Node (i, j) stands at (i, j)·span·L/nx: cells are square, size_x = span·L and size_y = size_x·ny/nx.
// The surface's aliased_share is that of the waves it was made of that turn more than half a turn
// per cell along their own direction: 0 for WaveBand::resolved. Orders too small to change a bit of
// the heights (together under 2⁻⁶⁰ of order 0) are skipped in the sum but not in the share.
// Made again on other square cells it is the same waves, whatever the new grid carries: those past its
// Nyquist alias, and a `resolved` surface keeps the orders it has. phase_function is called on this thread,
// once for every (m, n), n outer and m inner. Cost: see sum_of_plane_waves; under half of the M·(n_max+1)
// waves remain there, since m and M−m are mirror images. Memory: the heights, tables of 32 MiB at most (nx +
// ny <= 65536) and about 120 bytes a wave. Thread-safe; the same bits for any number of threads. Throws
// Error{bad_value} naming the key, the wave (m, n) whose phase is not finite, or `band` when no wave is
// resolved.
Surface weierstrass_mandelbrot(const WeierstrassMandelbrotOptions& options,
                               Monitor& monitor = Monitor::silent());

}  // namespace asperity
