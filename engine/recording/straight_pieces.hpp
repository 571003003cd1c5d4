// SPDX-License-Identifier: GPL-3.0-or-later
// A recording cut into straight pieces, as few as its noise allows. Neighbouring pieces are joined, those
// whose common line costs least in squared misfit first, until every join left would cost more than
// `evidence` times the variance of the noise (bottom-up piecewise linear approximation; Keogh et al. 2001);
// then each cut is moved to where the lines at its two sides fit best. Deterministic; O(n log n) in the
// samples; no best of all cuttings is sought.
#pragma once

#include <cstddef>
#include <span>

#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// Sums of some samples about their means, from which the line that fits them best follows.
struct LineMoments {
  double n = 0, t = 0, y = 0;     // count and means
  double tt = 0, ty = 0, yy = 0;  // squares and products about the means

  void add(double time, double value);
  LineMoments joined(const LineMoments& next) const;
  double slope() const { return tt > 0 ? ty / tt : 0; }
  // Least squared misfit of a line; never negative.
  double misfit() const;
};

struct StraightPiece {
  std::size_t first = 0, last = 0;  // samples, the last one included
  LineMoments line;
};

// `time` increases strictly, `value` is finite, `noise` above zero; both as long. In order, without gaps.
Array<StraightPiece> straight_pieces(std::span<const double> time, std::span<const double> value,
                                     double noise, double evidence, Monitor& monitor);

}  // namespace asperity
