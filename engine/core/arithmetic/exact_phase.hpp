// SPDX-License-Identifier: GPL-3.0-or-later
// Exact phases of plane waves whose wave number grows geometrically. Wave (m, n), m = 1 … M and
// n = 0 … n_max, turns u = γⁿ·(cos(πm/M), sin(πm/M))·span/cells times per grid step; γⁿ outgrows
// what a double can place on the circle long before the published n_max = 100. Only the fraction of
// u matters, so it is computed once in enough precision (MPFR) and kept in units of 2⁻⁶⁴ turn:
// the phase at node i is i·increment, and the overflow of a 64-bit integer is the reduction.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/core/memory.hpp"

namespace asperity {

// A point of the unit circle.
struct UnitPhase {
  double cosine = 1, sine = 0;
};

// Cosine and sine of `turns`·2⁻⁶⁴ of a full turn, to one unit in the last place; exact at multiples
// of a quarter turn.
UnitPhase unit_phase(std::uint64_t turns);

// The increments of all M·(n_max+1) waves: floor(2⁶⁴·frac(u) + ½) modulo 2⁶⁴.
struct PhaseIncrements {
  int directions = 0;  // M
  int n_max = 0;
  int last_resolved = -1;     // greatest n with γⁿ·span/cells ≤ ½ (at most half a turn per grid step,
                              // Nyquist's limit along the wave); -1 if there is none
  Array<std::uint64_t> x, y;  // turns per grid step in x and in y; wave (m, n) is at index(m, n)

  std::size_t index(int m, int n) const {
    return static_cast<std::size_t>(n) * static_cast<std::size_t>(directions) +
           static_cast<std::size_t>(m - 1);
  }
};

// Limits of the table: γ^n_max ≤ 2^2048, and the counts below.
inline constexpr double max_wave_octaves = 2048;
inline constexpr int max_wave_order = 4096;                       // n_max
inline constexpr int max_wave_directions = 65536;                 // M
inline constexpr std::int64_t max_waves = std::int64_t{1} << 22;  // M·(n_max+1)

// Greatest n_max accepted with this γ > 1.
int greatest_wave_order(double gamma);

// `gamma` and `span` are taken as the exact values of the doubles, `cells` is the number of grid
// steps in `span`; the same step serves x and y. Precision: as many bits as u has before the point,
// 64 for the result and 64 to guard, never under 384. Waves m and M−m get exactly opposite
// increments in x and equal ones in y; where cos or sin is 0, ±½ or ±1 it is taken exactly.
// Cost: about 0.3 µs a wave and 16 bytes. Thread-safe; leaves no cache behind.
// Throws Error{bad_value} naming `gamma`, `n_max`, `M`, `span` or `cells`; `n_max` when
// n_max·log2 γ > 2048 or n_max > 4096; `span` when even wave n_max turns less than 2⁻³² times a step.
PhaseIncrements phase_increments(double gamma, double span, int cells, int directions, int n_max);

}  // namespace asperity
