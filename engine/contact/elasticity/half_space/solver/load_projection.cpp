// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/solver/load_projection.hpp"

#include <algorithm>

#include "engine/core/parallel.hpp"

namespace asperity {

bool project_to_load(std::span<const double> y, std::span<const std::uint8_t> where, double upper,
                     double load, std::span<double> target) {
  const AllNodes nodes(y.size());
  return project_to_load(nodes, y.data(), where.empty() ? nullptr : where.data(), upper, load, true,
                         target.data());
}

bool keeps_line_loads(double aspect) {
  constexpr double long_cells = 8;
  return aspect >= long_cells || aspect * long_cells <= 1;
}

void keep_line_loads(const LevelShape& shape, std::span<const double> before,
                     std::span<const std::uint8_t> where, double upper, std::span<double> settled) {
  constexpr int most_steps = 40;
  const bool rows = shape.aspect > 1;
  const auto nx = static_cast<std::size_t>(shape.nx);
  const std::size_t line_step = rows ? nx : 1, node_step = rows ? 1 : nx;
  const auto length = static_cast<std::size_t>(rows ? shape.nx : shape.ny);
  parallel_for(rows ? shape.ny : shape.nx, [&](std::int64_t line) {
    const std::size_t begin = static_cast<std::size_t>(line) * line_step;
    double wanted = 0, bound = 0;
    bool same = true;
    for (std::size_t i = 0, k = begin; i < length; ++i, k += node_step) {
      wanted += before[k];
      if (where[k] == 0) bound += settled[k];
      same = same && before[k] == settled[k];
    }
    if (same) return;
    double shift = 0;
    for (int step = 0; step < most_steps; ++step) {
      double load = bound, inside = 0;
      for (std::size_t i = 0, k = begin; i < length; ++i, k += node_step)
        if (where[k] != 0) {
          const double moved = settled[k] + shift;
          load += std::clamp(moved, 0.0, upper);
          inside += moved > 0 && moved < upper ? 1.0 : 0.0;
        }
      const double next = inside > 0 ? shift + (wanted - load) / inside : shift;
      if (next == shift) break;
      shift = next;
    }
    for (std::size_t i = 0, k = begin; i < length; ++i, k += node_step)
      if (where[k] != 0) settled[k] = std::clamp(settled[k] + shift, 0.0, upper);
  });
}

}  // namespace asperity
