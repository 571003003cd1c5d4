// SPDX-License-Identifier: GPL-3.0-or-later
// Loops over the nodes of a grid in fixed blocks shared over threads, with sums and minima taken in fixed
// lanes and blocks: the same bits for any number of threads. A term may also write to its own node, so
// that an update and the sums over its result cost one pass over memory.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "engine/core/memory.hpp"
#include "engine/core/parallel.hpp"

namespace asperity {

inline constexpr std::size_t nodes_a_block = 8192;
inline constexpr std::size_t lanes_a_block = 8;

// body(begin, end) for each block.
template <class Body>
void for_node_blocks(std::size_t nodes, Body body) {
  const auto blocks = static_cast<std::int64_t>((nodes + nodes_a_block - 1) / nodes_a_block);
  parallel_for(blocks, [&](std::int64_t b) {
    const std::size_t begin = static_cast<std::size_t>(b) * nodes_a_block;
    body(begin, std::min(begin + nodes_a_block, nodes));
  });
}

// body(k) for each node.
template <class Body>
void for_nodes(std::size_t nodes, Body body) {
  for_node_blocks(nodes, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) body(k);
  });
}

// term(k, v) sets v[0 … sums) to what node k adds to each sum, and the rest to what it offers to each
// minimum; both are returned in that order. A minimum over nothing is +∞.
template <std::size_t sums, std::size_t minima = 0, class Term>
std::array<double, sums + minima> over_nodes(std::size_t nodes, Term term) {
  constexpr std::size_t size = sums + minima;
  constexpr double none = std::numeric_limits<double>::infinity();
  using Parts = std::array<double, size>;
  const std::size_t blocks = (nodes + nodes_a_block - 1) / nodes_a_block;
  Array<Parts> parts(blocks);
  auto merge = [](Parts& into, const Parts& from) {
    for (std::size_t i = 0; i < sums; ++i) into[i] += from[i];
    for (std::size_t i = sums; i < size; ++i) into[i] = from[i] < into[i] ? from[i] : into[i];
  };
  for_node_blocks(nodes, [&](std::size_t begin, std::size_t end) {
    double lanes[size][lanes_a_block];
    for (std::size_t i = 0; i < size; ++i)
      for (double& lane : lanes[i]) lane = i < sums ? 0.0 : none;
    const Term own = term;
    auto take = [&](std::size_t k, std::size_t lane) {
      double v[size];
      own(k, v);
      for (std::size_t i = 0; i < sums; ++i) lanes[i][lane] += v[i];
      for (std::size_t i = sums; i < size; ++i)
        lanes[i][lane] = v[i] < lanes[i][lane] ? v[i] : lanes[i][lane];
    };
    std::size_t k = begin;
    for (; k + lanes_a_block <= end; k += lanes_a_block)
      for (std::size_t lane = 0; lane < lanes_a_block; ++lane) take(k + lane, lane);
    for (std::size_t lane = 0; k < end; ++k, ++lane) take(k, lane);
    Parts& part = parts[begin / nodes_a_block];
    for (std::size_t i = 0; i < size; ++i) part[i] = lanes[i][0];
    for (std::size_t lane = 1; lane < lanes_a_block; ++lane) {
      Parts other;
      for (std::size_t i = 0; i < size; ++i) other[i] = lanes[i][lane];
      merge(part, other);
    }
  });
  Parts total;
  for (std::size_t i = 0; i < size; ++i) total[i] = i < sums ? 0.0 : none;
  for (const Parts& part : parts) merge(total, part);
  return total;
}

}  // namespace asperity
