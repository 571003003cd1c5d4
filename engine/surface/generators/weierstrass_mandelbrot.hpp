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
#include <span>
#include <string_view>

#include "engine/core/grid.hpp"
#include "engine/core/monitor.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// w(i, j) = Σ a cos(2π(sx·i + sy·j)/2⁶⁴ + φ) on a grid, as a matrix product nx × 2K by 2K × ny of cosines and
// sines. Mirror images in x or y share columns; a wave along an axis costs a vector. The waves need not fit
// the grid.

struct PlaneWave {
  std::uint64_t step_x = 0, step_y = 0;  // turns per grid step, in 2⁻⁶⁴
  double amplitude = 0;                  // unit of the heights
  double phase = 0;                      // rad
};

// Preconditions: 1 <= nx, ny <= max_cells, finite amplitudes and phases. Error: about 4e-16 · √K times the
// root sum of squares of the amplitudes. Cost: 4·nx·ny·K flops, K waves after mirroring. Memory: the field,
// under 100 bytes a wave, tables of 64 MiB at most.
Field sum_of_plane_waves(int nx, int ny, std::span<const PlaneWave> waves, Monitor& monitor,
                         std::string_view what);

enum class WavePhases { seeded, golden, function };
enum class WaveBand {
  all,       // waves past Nyquist alias, nearly white noise
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

// Share of variance in orders n > last_resolved; order n: proportional to γ^(2(D−3)n).
double share_of_variance_beyond(int last_resolved, double D, double gamma, int n_max);

// Node (i, j) is at (i, j)·span·L/nx: square cells, size_x = span·L, size_y = size_x·ny/nx. aliased_share:
// waves beyond half a turn per cell. Orders that cannot change a bit are skipped in the sum, not in the
// share. The recipe keeps all waves on other square cells. phase_function runs on this thread, once per (m,
// n), m inner. Cost: sum_of_plane_waves with under half of M·(n_max+1) waves; about 120 bytes a wave.
// Thread-safe. Throws Error{bad_value} naming the key, the wave (m, n) of a non-finite phase, or `band` if no
// wave is resolved.
Surface weierstrass_mandelbrot(const WeierstrassMandelbrotOptions& options,
                               Monitor& monitor = Monitor::silent());

}  // namespace asperity
