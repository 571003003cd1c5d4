// SPDX-License-Identifier: GPL-3.0-or-later
// An elastic body whose compliance differs from that of a half-space wave by wave: a layer. Plans carry the
// compliance to operators and preconditioners.
#pragma once

#include <functional>
#include <vector>

namespace asperity {

// Compliance of one wave relative to a half-space: K(q) = share · 2/(E*|q|).
struct WaveShare {
  // In [0, 1] at x = |q| length: 0 at 0, 1 at infinity. K(q) falls beyond x = 4.
  std::function<double(double x)> share;
  double length = 0;                 // m
  double uniform = 0;                // K(0) E*/length
  std::vector<double> parameters{};  // for digests
};

}  // namespace asperity
