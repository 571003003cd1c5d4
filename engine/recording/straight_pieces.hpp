// SPDX-License-Identifier: GPL-3.0-or-later
// A recording cut into few straight pieces: neighbours with the least increase of squared misfit are joined
// until a join costs more than `evidence` noise variances (bottom-up piecewise linear approximation; Keogh et
// al. 2001); then each cut moves to the best fit. Deterministic; O(n log n); not a global optimum.
#pragma once

#include <cstddef>
#include <span>

#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

struct LineMoments {
  double n = 0, t = 0, y = 0;     // count, means
  double tt = 0, ty = 0, yy = 0;  // about the means

  void add(double time, double value);
  LineMoments joined(const LineMoments& next) const;
  double slope() const { return tt > 0 ? ty / tt : 0; }
  // Squared misfit of the best line; never negative.
  double misfit() const;
};

struct StraightPiece {
  std::size_t first = 0, last = 0;  // samples, inclusive
  LineMoments line;
};

// `time` increases strictly; `value` is finite; `noise` > 0. In order, without gaps.
Array<StraightPiece> straight_pieces(std::span<const double> time, std::span<const double> value,
                                     double noise, double evidence, Monitor& monitor);

}  // namespace asperity
