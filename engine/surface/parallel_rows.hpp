// SPDX-License-Identifier: GPL-3.0-or-later
// Parallel loops over numbers and rows, in fixed blocks, each on one thread.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"
#include "engine/core/parallel.hpp"

namespace asperity {

// Calls part(first, last) for consecutive blocks of [0, n).
template <class Part>
void for_each_block(std::size_t n, std::size_t block, const Part& part) {
  parallel_for(static_cast<std::int64_t>((n + block - 1) / block), [&](std::int64_t k) {
    const std::size_t first = static_cast<std::size_t>(k) * block;
    part(first, std::min(n, first + block));
  });
}

template <int rows_per_block = 16, class Row>
void for_each_row(int ny, const Row& row) {
  for_each_block(static_cast<std::size_t>(ny), rows_per_block, [&](std::size_t first, std::size_t last) {
    for (std::size_t j = first; j < last; ++j) row(static_cast<int>(j));
  });
}

// Calls row(j, scratch) with `scratch` numbers of memory per block.
template <class Row>
void for_each_row_reported(int ny, std::size_t scratch, Monitor& monitor, std::string_view what,
                           const Row& row) {
  constexpr int rows_a_block = 4, rows_a_turn = 256;
  Task task(monitor, what, ny);
  for (int first = 0; first < ny; first += rows_a_turn) {
    const int rows = std::min(rows_a_turn, ny - first);
    for_each_block(static_cast<std::size_t>(rows), rows_a_block, [&](std::size_t begin, std::size_t end) {
      Array<double> own(scratch);
      for (std::size_t j = begin; j < end; ++j) row(first + static_cast<int>(j), own);
    });
    task.advance(rows);
  }
}

// Non-negative remainder.
inline int wrapped_index(std::int64_t k, int n) {
  const std::int64_t rest = k % n;
  return static_cast<int>(rest < 0 ? rest + n : rest);
}

}  // namespace asperity
