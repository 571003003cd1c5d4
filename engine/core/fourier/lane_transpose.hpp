// SPDX-License-Identifier: GPL-3.0-or-later
// Squares of numbers turned over their diagonal in registers: rows of a field become the lanes of vectors
// (fourier_lanes.hpp), and back. Included only by sources of this folder.
#pragma once

#include <utility>

#include "engine/core/fourier/fourier_lanes.hpp"

namespace asperity::lane_transpose {

namespace places {

// Of `lanes` values of two vectors: where each of a result comes from.
template <int lanes, class Of, int... l>
inline __attribute__((always_inline)) void shuffle_by(const auto& a, const auto& b, auto& to, Of,
                                                      std::integer_sequence<int, l...>) {
  to = __builtin_shufflevector(a, b, Of::place(l)...);
}
template <int lanes, class Of, class Vector>
inline __attribute__((always_inline)) void shuffle(const Vector& a, const Vector& b, Vector& to) {
  shuffle_by<lanes>(a, b, to, Of{}, std::make_integer_sequence<int, lanes>{});
}

// Squares of `step` values on the diagonal stay, those beside it change places.
template <int lanes, int step>
struct Upper {
  static constexpr int place(int l) { return (l & step) != 0 ? l - step + lanes : l; }
};
template <int lanes, int step>
struct Lower {
  static constexpr int place(int l) { return (l & step) != 0 ? l + lanes : l + step; }
};
template <int lanes, int first>
struct Interleaved {
  static constexpr int place(int l) { return (first + l) / 2 + ((l & 1) != 0 ? lanes : 0); }
};
template <int lanes, int first>
struct EverySecond {
  static constexpr int place(int l) { return 2 * l + first; }
};

}  // namespace places

template <int lanes, int step, class Vector>
inline __attribute__((always_inline)) void exchange(Vector* x) {
  for (int i = 0; i < lanes; ++i) {
    if ((i & step) != 0) continue;
    Vector upper, lower;
    places::shuffle<lanes, places::Upper<lanes, step>>(x[i], x[i + step], upper);
    places::shuffle<lanes, places::Lower<lanes, step>>(x[i], x[i + step], lower);
    x[i] = upper;
    x[i + step] = lower;
  }
  if constexpr (2 * step < lanes) exchange<lanes, 2 * step>(x);
}

// x[i][l] and x[l][i] change places.
template <int lanes, class Vector>
inline __attribute__((always_inline)) void transpose(Vector* x) {
  exchange<lanes, 1>(x);
}

// a0 b0 a1 b1 …, the first half in `low`.
template <class Vector>
inline __attribute__((always_inline)) void interleave(const Vector& a, const Vector& b, Vector& low,
                                                      Vector& high) {
  constexpr int lanes = sizeof(Vector) / sizeof(a[0]);
  Vector l;
  places::shuffle<lanes, places::Interleaved<lanes, 0>>(a, b, l);
  places::shuffle<lanes, places::Interleaved<lanes, lanes>>(a, b, high);
  low = l;
}

// a0 a1 … from a0 b0 a1 b1 …: what interleave() undoes.
template <class Vector>
inline __attribute__((always_inline)) void separate(const Vector& low, const Vector& high, Vector& a,
                                                    Vector& b) {
  constexpr int lanes = sizeof(Vector) / sizeof(low[0]);
  Vector first;
  places::shuffle<lanes, places::EverySecond<lanes, 0>>(low, high, first);
  places::shuffle<lanes, places::EverySecond<lanes, 1>>(low, high, b);
  a = first;
}

}  // namespace asperity::lane_transpose
