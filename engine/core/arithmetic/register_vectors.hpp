// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors of one processor register: shuffles and conversions. GCC 12 keeps wider vectors on the stack, five
// to ten times slower.
//
// Only for sources compiled for one processor: width and layout differ. Pass vectors by reference: their
// calling convention depends on the processor.
#pragma once

#include <cstdint>
#include <cstring>
#include <utility>

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace asperity {

#if defined(__AVX512F__) && defined(__AVX512VL__)
inline constexpr int register_bytes = 64;
#elif defined(__AVX2__)
inline constexpr int register_bytes = 32;
#else
inline constexpr int register_bytes = 16;
#endif

namespace register_vectors {

template <class Number>
inline constexpr int register_lanes = register_bytes / static_cast<int>(sizeof(Number));

// `Anywhere` is aligned as one number. Use only pointers to it: Clang drops the alignment of references and
// template arguments.
template <class Number, int lanes = register_lanes<Number>>
struct Of {
  typedef Number Vector __attribute__((vector_size(lanes * sizeof(Number)), may_alias));
  typedef Number Anywhere
      __attribute__((vector_size(lanes * sizeof(Number)), aligned(alignof(Number)), may_alias));
};

// -- Shuffles: lane l of the result is lane `Place::of(l)` of a, b.

template <class Place, class From, class To, int... l>
inline __attribute__((always_inline)) void shuffle(const From& a, const From& b, To& to,
                                                   std::integer_sequence<int, l...>) {
  to = __builtin_shufflevector(a, b, Place::of(l)...);
}
template <class Place, class From, class To>
inline __attribute__((always_inline)) void shuffle(const From& a, const From& b, To& to) {
  shuffle<Place>(a, b, to, std::make_integer_sequence<int, sizeof(To) / sizeof(to[0])>{});
}

// Lanes first, first + 1, … of a0 b0 a1 b1 …
template <int lanes, int first>
struct Interleaved {
  static constexpr int of(int l) { return (first + l) / 2 + ((first + l) % 2 != 0 ? lanes : 0); }
};
template <int first>
struct EverySecond {
  static constexpr int of(int l) { return 2 * l + first; }
};
template <int first>
struct Stretch {
  static constexpr int of(int l) { return first + l; }
};
// Two rows of blocks of `step` lanes: off-diagonal blocks exchange rows.
template <int lanes, int step>
struct UpperRow {
  static constexpr int of(int l) { return (l & step) != 0 ? l - step + lanes : l; }
};
template <int lanes, int step>
struct LowerRow {
  static constexpr int of(int l) { return (l & step) != 0 ? l + lanes : l + step; }
};

// low, high = a0 b0 a1 b1 …
template <class Vector>
inline __attribute__((always_inline)) void interleave(const Vector& a, const Vector& b, Vector& low,
                                                      Vector& high) {
  constexpr int lanes = sizeof(Vector) / sizeof(a[0]);
  Vector first;
  shuffle<Interleaved<lanes, 0>>(a, b, first);
  shuffle<Interleaved<lanes, lanes>>(a, b, high);
  low = first;
}
// The inverse of interleave.
template <class Vector>
inline __attribute__((always_inline)) void separate(const Vector& low, const Vector& high, Vector& a,
                                                    Vector& b) {
  Vector first;
  shuffle<EverySecond<0>>(low, high, first);
  shuffle<EverySecond<1>>(low, high, b);
  a = first;
}

// Transposes x[i][l]: steps 1, 2, 4 …, one shuffle per row and step.
template <int step, class Vector>
inline __attribute__((always_inline)) void exchange_blocks(Vector* x) {
  constexpr int lanes = sizeof(Vector) / sizeof((*x)[0]);
  for (int i = 0; i < lanes; ++i) {
    if ((i & step) != 0) continue;
    Vector upper, lower;
    shuffle<UpperRow<lanes, step>>(x[i], x[i + step], upper);
    shuffle<LowerRow<lanes, step>>(x[i], x[i + step], lower);
    x[i] = upper;
    x[i + step] = lower;
  }
  if constexpr (2 * step < lanes) exchange_blocks<2 * step>(x);
}
template <class Vector>
inline __attribute__((always_inline)) void transpose(Vector* x) {
  exchange_blocks<1>(x);
}

// -- Conversions to and from unaligned memory.

template <class Doubles>
inline constexpr int lanes_of = static_cast<int>(sizeof(Doubles) / sizeof(double));

template <class Doubles>
inline __attribute__((always_inline)) void read(const double* from, Doubles& to) {
  to = *reinterpret_cast<const typename Of<double, lanes_of<Doubles>>::Anywhere*>(from);
}
template <class Doubles>
inline __attribute__((always_inline)) void read(const float* from, Doubles& to) {
  to = __builtin_convertvector(
      *reinterpret_cast<const typename Of<float, lanes_of<Doubles>>::Anywhere*>(from), Doubles);
}
template <class Doubles>
inline __attribute__((always_inline)) void read(const std::uint8_t* from, Doubles& to) {
  using Words = typename Of<std::uint16_t, lanes_of<Doubles>>::Vector;
  using Integers = typename Of<std::int32_t, lanes_of<Doubles>>::Vector;
  const Words words = __builtin_convertvector(
      *reinterpret_cast<const typename Of<std::uint8_t, lanes_of<Doubles>>::Anywhere*>(from), Words);
  to = __builtin_convertvector(__builtin_convertvector(words, Integers), Doubles);
}

template <class Doubles>
inline __attribute__((always_inline)) void write(const Doubles& from, double* to) {
  *reinterpret_cast<typename Of<double, lanes_of<Doubles>>::Anywhere*>(to) = from;
}
template <class Doubles>
inline __attribute__((always_inline)) void write(const Doubles& from, float* to) {
  using Floats = typename Of<float, lanes_of<Doubles>>::Vector;
  *reinterpret_cast<typename Of<float, lanes_of<Doubles>>::Anywhere*>(to) =
      __builtin_convertvector(from, Floats);
}
// Values from 0 to 255, rounded down.
template <class Doubles>
inline __attribute__((always_inline)) void write(const Doubles& from, std::uint8_t* to) {
  using Bytes = typename Of<std::uint8_t, lanes_of<Doubles>>::Vector;
  using Words = typename Of<std::uint16_t, lanes_of<Doubles>>::Vector;
  using Integers = typename Of<std::int32_t, lanes_of<Doubles>>::Vector;
  const Words words = __builtin_convertvector(__builtin_convertvector(from, Integers), Words);
  *reinterpret_cast<typename Of<std::uint8_t, lanes_of<Doubles>>::Anywhere*>(to) =
      __builtin_convertvector(words, Bytes);
}

template <class Doubles, class Floats>
inline __attribute__((always_inline)) void narrow(const Doubles& low, const Doubles& high, Floats& to) {
  using Half = typename Of<float, lanes_of<Doubles>>::Vector;
  const Half first = __builtin_convertvector(low, Half), last = __builtin_convertvector(high, Half);
  shuffle<Stretch<0>>(first, last, to);
}
template <class Floats, class Doubles>
inline __attribute__((always_inline)) void widen(const Floats& from, Doubles& low, Doubles& high) {
  typename Of<float, lanes_of<Doubles>>::Vector half;
  shuffle<Stretch<0>>(from, from, half);
  low = __builtin_convertvector(half, Doubles);
  shuffle<Stretch<lanes_of<Doubles>>>(from, from, half);
  high = __builtin_convertvector(half, Doubles);
}

// GCC 12 reads bytes one by one.
#if defined(__AVX2__)
inline __attribute__((always_inline)) void read(const float* from, Of<double, 4>::Vector& to) {
  to = reinterpret_cast<Of<double, 4>::Vector>(_mm256_cvtps_pd(_mm_loadu_ps(from)));
}
inline __attribute__((always_inline)) void read(const std::uint8_t* from, Of<double, 4>::Vector& to) {
  std::int32_t four;
  std::memcpy(&four, from, sizeof four);
  to =
      reinterpret_cast<Of<double, 4>::Vector>(_mm256_cvtepi32_pd(_mm_cvtepu8_epi32(_mm_cvtsi32_si128(four))));
}
inline __attribute__((always_inline)) void write(const Of<double, 4>::Vector& from, std::uint8_t* to) {
  // The lowest byte of each integer.
  const __m128i integers = _mm256_cvttpd_epi32(reinterpret_cast<__m256d>(from));
  const __m128i bytes = _mm_shuffle_epi8(integers, _mm_set1_epi32(0x0c080400));
  const std::int32_t four = _mm_cvtsi128_si32(bytes);
  std::memcpy(to, &four, sizeof four);
}
#endif
#if defined(__AVX512F__) && defined(__AVX512VL__)
inline __attribute__((always_inline)) void read(const float* from, Of<double, 8>::Vector& to) {
  to = reinterpret_cast<Of<double, 8>::Vector>(_mm512_maskz_cvtps_pd(0xff, _mm256_loadu_ps(from)));
}
inline __attribute__((always_inline)) void read(const std::uint8_t* from, Of<double, 8>::Vector& to) {
  const __m128i bytes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from));
  to = reinterpret_cast<Of<double, 8>::Vector>(_mm512_maskz_cvtepi32_pd(0xff, _mm256_cvtepu8_epi32(bytes)));
}
#endif

}  // namespace register_vectors

}  // namespace asperity
