// SPDX-License-Identifier: GPL-3.0-or-later
// What a periodic tile makes of one wave of pressure: K(q) = 2/(E*|q|) of a half-space, and a share of that
// of what lies in its place, told by the model of elasticity that knows it (WaveShare). Operators and
// preconditioners ask once for each wave of a grid, in cell units (hx = 1, E* = 1), and keep what they need.
#pragma once

#include <functional>
#include <limits>
#include <vector>

namespace asperity {

struct WaveShare {
  // In [0, 1] at x = |q| length, 0 at 0; goes to 1 as x grows, and past x = 4 K(q) falls.
  std::function<double(double x)> share;
  double length = 0;                 // m
  double uniform = 0;                // K(0) E*/length; 0: a mean pressure moves nothing
  std::vector<double> parameters{};  // by which it differs from others, for digests
};

struct ComplianceMultiplier {
  std::function<double(double x)> share_of{};               // none: a half-space
  double length = std::numeric_limits<double>::infinity();  // of a WaveShare, in cells along x
  double uniform = 0;                                       // K(0); 0: a mean pressure moves nothing

  bool shares() const { return share_of != nullptr; }
  // K(q)·q/2, 1 of a half-space. q > 0.
  double share(double q) const { return shares() ? share_of(q * length) : 1; }
  // The greatest K of waves from q on: that of q, but where short waves meet what is softer to them.
  double greatest_from(double q) const;
  // On a grid whose cells are `pitch` times as wide.
  ComplianceMultiplier on_coarser(double pitch) const;
};

// On cells `hx` m wide. `with_mean`: with its K(0).
ComplianceMultiplier in_cells(const WaveShare& share, double hx, bool with_mean);

}  // namespace asperity
