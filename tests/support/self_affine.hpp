// SPDX-License-Identifier: GPL-3.0-or-later
// Options of a self-affine surface; the caller sets its height.
#pragma once

#include "engine/surface/generators/self_affine.hpp"

namespace asperity::test {

inline SelfAffineOptions self_affine(const Grid& grid, double hurst, double short_wave,
                                     std::uint64_t seed = 1) {
  SelfAffineOptions options;
  options.grid = grid;
  options.hurst = hurst;
  options.short_wave = short_wave;
  options.seed = seed;
  return options;
}

}  // namespace asperity::test
