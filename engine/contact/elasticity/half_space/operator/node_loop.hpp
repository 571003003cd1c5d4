// SPDX-License-Identifier: GPL-3.0-or-later
// Loops over grid nodes with sums and minima in fixed lanes and blocks: same bits for any number of threads
// and vector width. A term may write to its own node: an update and its sums need one pass over memory.
// Chunks vectorise. Terms should capture by value (a byte store may alias a reference), read before they
// decide, and select instead of branch.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "engine/core/arithmetic/register_vectors.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/parallel.hpp"

namespace asperity {

inline constexpr std::size_t nodes_a_block = 8192;
inline constexpr std::size_t nodes_a_chunk = 64;
inline constexpr std::size_t lanes_a_block = 8;

template <class Body>
void for_node_blocks(std::size_t nodes, Body body) {
  const auto blocks = static_cast<std::int64_t>((nodes + nodes_a_block - 1) / nodes_a_block);
  parallel_for(blocks, [&](std::int64_t b) {
    const std::size_t begin = static_cast<std::size_t>(b) * nodes_a_block;
    body(begin, std::min(begin + nodes_a_block, nodes));
  });
}

namespace node_loop {

// A register holds part of the lanes.
using LaneVector = register_vectors::Of<double>::Vector;
inline constexpr std::size_t lanes_a_part = register_vectors::register_lanes<double>;
inline constexpr std::size_t parts_a_block = lanes_a_block / lanes_a_part;

template <std::size_t sums, std::size_t minima>
struct Lanes {
  static constexpr std::size_t size = sums + minima;
  using Parts = std::array<double, size>;
  LaneVector lanes[size][parts_a_block];

  double& lane(std::size_t i, std::size_t l) { return reinterpret_cast<double*>(lanes[i])[l]; }
  double lane(std::size_t i, std::size_t l) const { return reinterpret_cast<const double*>(lanes[i])[l]; }
  static constexpr double none(std::size_t i) {
    return i < sums ? 0.0 : std::numeric_limits<double>::infinity();
  }
  static double merge(std::size_t i, double into, double from) {
    return i < sums ? into + from : (from < into ? from : into);
  }
  Lanes() {
    for (std::size_t i = 0; i < size; ++i)
      for (LaneVector& part : lanes[i]) part = LaneVector{} + none(i);
  }
  // `k` counts whole lanes in the block.
  template <class Term>
  void take_chunk(std::size_t k, const Term& term) {
    alignas(64) double values[size][nodes_a_chunk];
    for (std::size_t j = 0; j < nodes_a_chunk; ++j) {
      double v[size];
      term(k + j, v);
      for (std::size_t i = 0; i < size; ++i) values[i][j] = v[i];
    }
    for (std::size_t i = 0; i < size; ++i) {
      LaneVector into[parts_a_block];
      for (std::size_t part = 0; part < parts_a_block; ++part) into[part] = lanes[i][part];
      for (std::size_t j = 0; j < nodes_a_chunk; j += lanes_a_block)
        for (std::size_t part = 0; part < parts_a_block; ++part) {
          const LaneVector from = *reinterpret_cast<const LaneVector*>(values[i] + j + part * lanes_a_part);
          if (i < sums)
            into[part] += from;
          else
            into[part] = from < into[part] ? from : into[part];
        }
      for (std::size_t part = 0; part < parts_a_block; ++part) lanes[i][part] = into[part];
    }
  }
  template <class Term>
  void take(std::size_t k, std::size_t l, const Term& term) {
    double v[size];
    term(k, v);
    for (std::size_t i = 0; i < size; ++i) lane(i, l) = merge(i, lane(i, l), v[i]);
  }
  Parts total() const {
    Parts total;
    for (std::size_t i = 0; i < size; ++i) {
      total[i] = lane(i, 0);
      for (std::size_t l = 1; l < lanes_a_block; ++l) total[i] = merge(i, total[i], lane(i, l));
    }
    return total;
  }
};

template <std::size_t sums, std::size_t minima, class Range>
std::array<double, sums + minima> gather_blocks(std::size_t nodes, const Range& range) {
  using Block = Lanes<sums, minima>;
  const std::size_t blocks = (nodes + nodes_a_block - 1) / nodes_a_block;
  Array<typename Block::Parts> parts(blocks);
  for_node_blocks(
      nodes, [&](std::size_t begin, std::size_t end) { parts[begin / nodes_a_block] = range(begin, end); });
  typename Block::Parts total;
  for (std::size_t i = 0; i < Block::size; ++i) {
    total[i] = Block::none(i);
    for (const auto& part : parts) total[i] = Block::merge(i, total[i], part[i]);
  }
  return total;
}

}  // namespace node_loop

// On this thread.
template <class Body>
void for_stretch(std::size_t begin, std::size_t end, const Body& body) {
  const Body own = body;
  for (std::size_t k = begin; k < end; ++k) own(k);
}
template <std::size_t sums, std::size_t minima = 0, class Term>
std::array<double, sums + minima> over_stretch(std::size_t begin, std::size_t end, const Term& term) {
  const Term own = term;
  node_loop::Lanes<sums, minima> block;
  std::size_t k = begin;
  for (; k + nodes_a_chunk <= end; k += nodes_a_chunk) block.take_chunk(k, own);
  for (std::size_t lane = 0; k < end; ++k, lane = (lane + 1) % lanes_a_block) block.take(k, lane, own);
  return block.total();
}

template <class Body>
void for_nodes(std::size_t nodes, Body body) {
  for_node_blocks(nodes, [&](std::size_t begin, std::size_t end) {
    const Body own = body;
    std::size_t k = begin;
    for (; k + nodes_a_chunk <= end; k += nodes_a_chunk)
      for (std::size_t j = 0; j < nodes_a_chunk; ++j) own(k + j);
    for (; k < end; ++k) own(k);
  });
}

// term(k, v) sets v[0 … sums) to summands, then candidates for minima; returned in this order. A minimum over
// nothing is +∞.
template <std::size_t sums, std::size_t minima = 0, class Term>
std::array<double, sums + minima> over_nodes(std::size_t nodes, Term term) {
  return node_loop::gather_blocks<sums, minima>(nodes, [&](std::size_t begin, std::size_t end) {
    return over_stretch<sums, minima>(begin, end, term);
  });
}

// Adds in order.
template <std::size_t sums>
std::array<double, sums> added_up(const Array<std::array<double, sums>>& parts) {
  std::array<double, sums> total{};
  for (const auto& part : parts)
    for (std::size_t i = 0; i < sums; ++i) total[i] += part[i];
  return total;
}

// Same bits, for hot loops, sums in registers. A term is a template of Value: a vector of lanes or, for the
// last nodes, a double. read() and put() access fields; comparisons select: `a < b ? c : d`.
namespace lane_terms {

using node_loop::LaneVector;

inline void read(const double* from, double& to) { to = *from; }
inline void read(const float* from, double& to) { to = static_cast<double>(*from); }
inline void read(const std::uint8_t* from, double& to) { to = *from; }
inline void put(const double& from, double* to) { *to = from; }
inline void put(const double& from, float* to) { *to = static_cast<float>(from); }
inline void put(const double& from, std::uint8_t* to) {
  *to = static_cast<std::uint8_t>(static_cast<int>(from));
}

template <class Number>
inline void read(const Number* from, LaneVector& to) {
  register_vectors::read(from, to);
}
template <class Number>
inline void put(const LaneVector& from, Number* to) {
  register_vectors::write(from, to);
}

}  // namespace lane_terms

// As over_nodes, over_stretch, for_nodes, for_stretch; body.operator()<Value>(k).
template <std::size_t sums, std::size_t minima = 0, class Term>
std::array<double, sums + minima> over_lanes_of_stretch(std::size_t begin, std::size_t end,
                                                        const Term& term) {
  const Term own = term;
  node_loop::Lanes<sums, minima> block;
  // A copy: the compiler keeps members in memory.
  node_loop::LaneVector lanes[sums + minima][node_loop::parts_a_block];
  std::memcpy(lanes, block.lanes, sizeof lanes);
  std::size_t k = begin;
  for (; k + lanes_a_block <= end; k += lanes_a_block)
    for (std::size_t part = 0; part < node_loop::parts_a_block; ++part) {
      node_loop::LaneVector v[sums + minima];
      own(k + part * node_loop::lanes_a_part, v);
      for (std::size_t i = 0; i < sums + minima; ++i) {
        node_loop::LaneVector& into = lanes[i][part];
        if (i < sums)
          into += v[i];
        else
          into = v[i] < into ? v[i] : into;
      }
    }
  std::memcpy(block.lanes, lanes, sizeof lanes);
  for (std::size_t lane = 0; k < end; ++k, ++lane) block.take(k, lane, own);
  return block.total();
}

template <class Body>
void for_lanes_of_stretch(std::size_t begin, std::size_t end, const Body& body) {
  const Body own = body;
  std::size_t k = begin;
  for (; k + node_loop::lanes_a_part <= end; k += node_loop::lanes_a_part)
    own.template operator()<node_loop::LaneVector>(k);
  for (; k < end; ++k) own.template operator()<double>(k);
}
template <std::size_t sums, std::size_t minima = 0, class Term>
std::array<double, sums + minima> over_lanes(std::size_t nodes, Term term) {
  return node_loop::gather_blocks<sums, minima>(nodes, [&](std::size_t begin, std::size_t end) {
    return over_lanes_of_stretch<sums, minima>(begin, end, term);
  });
}
template <class Body>
void for_lanes(std::size_t nodes, Body body) {
  for_node_blocks(nodes, [&](std::size_t begin, std::size_t end) { for_lanes_of_stretch(begin, end, body); });
}

// All nodes of a grid in one process; SlabLevel: of several processes.
class AllNodes {
 public:
  explicit AllNodes(std::size_t nodes) : nodes_(nodes) {}
  std::size_t nodes() const { return nodes_; }
  double all_nodes() const { return static_cast<double>(nodes_); }
  template <class Body>
  void each(Body body) const {
    for_nodes(nodes_, body);
  }
  template <std::size_t sums, std::size_t minima = 0, class Term>
  std::array<double, sums + minima> over(Term term) const {
    return over_nodes<sums, minima>(nodes_, term);
  }
  template <std::size_t sums, std::size_t minima = 0, class Term>
  std::array<double, sums + minima> in_lanes(Term term) const {
    return over_lanes<sums, minima>(nodes_, term);
  }
  // Local; failures become known in agree().
  template <class Body>
  void work(const Body& body) const {
    body();
  }
  void agree() const {}
  // From the first process with a number; NaN if none.
  double first_number(double own) const { return own; }

 private:
  std::size_t nodes_;
};

}  // namespace asperity
