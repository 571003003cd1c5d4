// SPDX-License-Identifier: GPL-3.0-or-later
// What the descents of one grid share: the fields they work on, how a stage ends, and how the chain hands
// pressures from one to the next.
#pragma once

#include <cstdint>
#include <limits>

#include "engine/core/memory.hpp"

namespace asperity {

struct DescentFields {
  explicit DescentFields(std::size_t nodes)
      : pressure(nodes), gap(nodes), image(nodes), free(nodes), old_free(nodes) {}

  UnsetArray<double> pressure;               // p: feasible between stages
  UnsetArray<double> gap;                    // K p − h
  UnsetArray<double> image;                  // what K makes of a direction, times a power of two
  UnsetArray<double> old_pressure, old_gap;  // of the pass before; made when first needed
  Array<std::uint8_t> free, old_free;        // nodes the present pass may move
};

struct StageEnd {
  bool converged = false;
  double residual = std::numeric_limits<double>::infinity();
  double best = std::numeric_limits<double>::infinity();
};

}  // namespace asperity
