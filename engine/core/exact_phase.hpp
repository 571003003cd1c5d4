// SPDX-License-Identifier: GPL-3.0-or-later
// Exact phases of plane waves with geometric wave numbers. Wave (m, n), m = 1 … M, n = 0 … n_max, makes u =
// γⁿ·(cos(πm/M), sin(πm/M))·span/cells turns per grid step. Doubles lose the phase long before the published
// n_max = 100; MPFR computes the fraction of u in units of 2⁻⁶⁴ turn. The phase at node i is i·increment
// modulo 2⁶⁴.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/core/memory.hpp"

namespace asperity {

struct UnitPhase {
  double cosine = 1, sine = 0;
};

// Cosine and sine of `turns`·2⁻⁶⁴ turn, to one unit in the last place; exact at quarter turns.
UnitPhase unit_phase(std::uint64_t turns);

// floor(2⁶⁴·frac(u) + ½) modulo 2⁶⁴ for M·(n_max+1) waves.
struct PhaseIncrements {
  int directions = 0;  // M
  int n_max = 0;
  int last_resolved = -1;     // greatest n with γⁿ·span/cells ≤ ½ (at most half a turn per grid step,
                              // Nyquist's limit along the wave); -1 if there is none
  Array<std::uint64_t> x, y;  // of wave (m, n) at index(m, n), per grid step

  std::size_t index(int m, int n) const {
    return static_cast<std::size_t>(n) * static_cast<std::size_t>(directions) +
           static_cast<std::size_t>(m - 1);
  }
};

// With γ^n_max ≤ 2^2048:
inline constexpr double max_wave_octaves = 2048;
inline constexpr int max_wave_order = 4096;                       // n_max
inline constexpr int max_wave_directions = 65536;                 // M
inline constexpr std::int64_t max_waves = std::int64_t{1} << 22;  // M·(n_max+1)

// Greatest n_max for γ > 1.
int greatest_wave_order(double gamma);

// `gamma` and `span` are exact as doubles. Waves m and M−m have exactly opposite increments in x and equal
// increments in y. About 0.3 µs and 16 bytes per wave. Thread-safe. Throws Error{bad_value} naming `gamma`,
// `n_max` (n_max·log2 γ > 2048 or n_max > 4096), `M`, `cells` or `span` (wave n_max makes less than 2⁻³² turn
// per step).
PhaseIncrements phase_increments(double gamma, double span, int cells, int directions, int n_max);

}  // namespace asperity
