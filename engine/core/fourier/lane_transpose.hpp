// SPDX-License-Identifier: GPL-3.0-or-later
// Squares of numbers turned over their diagonal in registers: rows of a field become the lanes of vectors
// (fourier_lanes.hpp), and back. Included only by sources of this folder.
#pragma once

#include "engine/core/fourier/fourier_lanes.hpp"

namespace asperity::lane_transpose {

using Singles = Lanes<float>::Vector;
using Doubles = Lanes<double>::Vector;

// a0 b0 a1 b1 …, the first half in `low`.
inline __attribute__((always_inline)) void interleave(const Doubles& a, const Doubles& b, Doubles& low,
                                                      Doubles& high) {
  const Doubles l = __builtin_shufflevector(a, b, 0, 8, 1, 9, 2, 10, 3, 11);
  high = __builtin_shufflevector(a, b, 4, 12, 5, 13, 6, 14, 7, 15);
  low = l;
}

inline __attribute__((always_inline)) void interleave(const Singles& a, const Singles& b, Singles& low,
                                                      Singles& high) {
  const Singles l = __builtin_shufflevector(a, b, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
  high = __builtin_shufflevector(a, b, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
  low = l;
}

// x[i][l] and x[l][i] change places: as many perfect shuffles of rows as there are bits in an index.
template <int lanes, class Vector>
inline __attribute__((always_inline)) void transpose(Vector* x) {
  for (int step = 1; step < lanes; step *= 2) {
    Vector y[lanes];
    for (int i = 0; i < lanes / 2; ++i) interleave(x[i], x[i + lanes / 2], y[2 * i], y[2 * i + 1]);
    for (int i = 0; i < lanes; ++i) x[i] = y[i];
  }
}

// a0 a1 … from a0 b0 a1 b1 …: what interleave() undoes.
inline __attribute__((always_inline)) void separate(const Doubles& low, const Doubles& high, Doubles& a,
                                                    Doubles& b) {
  const Doubles first = __builtin_shufflevector(low, high, 0, 2, 4, 6, 8, 10, 12, 14);
  b = __builtin_shufflevector(low, high, 1, 3, 5, 7, 9, 11, 13, 15);
  a = first;
}

}  // namespace asperity::lane_transpose
