// SPDX-License-Identifier: GPL-3.0-or-later
// Sums and minima over nodes as node_loop.hpp takes them, the same lanes and blocks and so the same bits, for
// the few loops that every pass of a descent waits for: their terms are written for eight nodes at once, with
// the sums in registers, where a compiler left to itself goes through memory or branches. A term is a
// template of Value, a vector of lanes or, for the last nodes of a stretch, a double; read() and put() move
// either from and to fields, and a comparison chooses between values of it: `a < b ? c : d`.
#pragma once

#include <cstddef>
#include <cstdint>

#if defined(__AVX512F__) && defined(__AVX512VL__)
#include <immintrin.h>
#endif

#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"

namespace asperity {

namespace lane_terms {

using node_loop::LaneVector;
static_assert(lanes_a_block == 8);
typedef double Doubles __attribute__((vector_size(64), aligned(8), may_alias));
typedef float Floats __attribute__((vector_size(32), aligned(4), may_alias));
typedef std::uint8_t Bytes __attribute__((vector_size(8), aligned(1), may_alias));
typedef std::uint16_t Words __attribute__((vector_size(16)));
typedef std::int32_t Integers __attribute__((vector_size(32)));

inline void read(const double* from, double& to) { to = *from; }
inline void read(const float* from, double& to) { to = static_cast<double>(*from); }
inline void read(const std::uint8_t* from, double& to) { to = *from; }
inline void put(const double& from, double* to) { *to = from; }
inline void put(const double& from, float* to) { *to = static_cast<float>(from); }
inline void put(const double& from, std::uint8_t* to) {
  *to = static_cast<std::uint8_t>(static_cast<int>(from));
}

inline void read(const double* from, LaneVector& to) { to = *reinterpret_cast<const Doubles*>(from); }
#if defined(__AVX512F__) && defined(__AVX512VL__)
// What takes a compiler left to itself several instructions each.
inline void read(const float* from, LaneVector& to) {
  to = reinterpret_cast<LaneVector>(_mm512_maskz_cvtps_pd(0xff, _mm256_loadu_ps(from)));
}
inline void read(const std::uint8_t* from, LaneVector& to) {
  const __m128i bytes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from));
  to = reinterpret_cast<LaneVector>(_mm512_maskz_cvtepi32_pd(0xff, _mm256_cvtepu8_epi32(bytes)));
}
#else
inline void read(const float* from, LaneVector& to) {
  to = __builtin_convertvector(*reinterpret_cast<const Floats*>(from), LaneVector);
}
// In steps that are single instructions.
inline void read(const std::uint8_t* from, LaneVector& to) {
  const Words words = __builtin_convertvector(*reinterpret_cast<const Bytes*>(from), Words);
  const Integers integers = __builtin_convertvector(words, Integers);
  to = __builtin_convertvector(integers, LaneVector);
}
#endif
inline void put(const LaneVector& from, double* to) { *reinterpret_cast<Doubles*>(to) = from; }
inline void put(const LaneVector& from, float* to) {
  *reinterpret_cast<Floats*>(to) = __builtin_convertvector(from, Floats);
}
inline void put(const LaneVector& from, std::uint8_t* to) {
  const Integers integers = __builtin_convertvector(from, Integers);
  const Words words = __builtin_convertvector(integers, Words);
  *reinterpret_cast<Bytes*>(to) = __builtin_convertvector(words, Bytes);
}

template <std::size_t sums, std::size_t minima, class Term>
std::array<double, sums + minima> gather_range(std::size_t begin, std::size_t end, const Term& term) {
  const Term own = term;
  node_loop::Lanes<sums, minima> block;
  std::size_t k = begin;
  for (; k + lanes_a_block <= end; k += lanes_a_block) {
    LaneVector v[sums + minima];
    own(k, v);
    for (std::size_t i = 0; i < sums + minima; ++i) {
      LaneVector& into = block.lanes[i];
      if (i < sums)
        into += v[i];
      else
        into = v[i] < into ? v[i] : into;
    }
  }
  for (std::size_t lane = 0; k < end; ++k, ++lane) block.take(k, lane, own);
  return block.total();
}

template <class Body>
void visit_range(std::size_t begin, std::size_t end, const Body& body) {
  const Body own = body;
  std::size_t k = begin;
  for (; k + lanes_a_block <= end; k += lanes_a_block) own.template operator()<LaneVector>(k);
  for (; k < end; ++k) own.template operator()<double>(k);
}

}  // namespace lane_terms

// As over_nodes and over_stretch.
template <std::size_t sums, std::size_t minima = 0, class Term>
std::array<double, sums + minima> over_lanes(std::size_t nodes, Term term) {
  return node_loop::gather_blocks<sums, minima>(nodes, [&](std::size_t begin, std::size_t end) {
    return lane_terms::gather_range<sums, minima>(begin, end, term);
  });
}
// As for_nodes and for_stretch, body.operator()<Value>(k) being for eight nodes or for one.
template <class Body>
void for_lanes(std::size_t nodes, Body body) {
  for_node_blocks(nodes,
                  [&](std::size_t begin, std::size_t end) { lane_terms::visit_range(begin, end, body); });
}
template <class Body>
void for_lanes_of_stretch(std::size_t begin, std::size_t end, const Body& body) {
  lane_terms::visit_range(begin, end, body);
}
template <std::size_t sums, class Term>
std::array<double, sums> over_lanes_of_stretch(std::size_t begin, std::size_t end, const Term& term) {
  return lane_terms::gather_range<sums, 0>(begin, end, term);
}

}  // namespace asperity
