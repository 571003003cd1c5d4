// SPDX-License-Identifier: GPL-3.0-or-later
// A small half-space contact solved directly: minimise ½ p·Kp − h·p + Σ max(0, p − Y)²/(2K_h) over 0 <= p
// <= H for a given mean. K is dense, from Love's (1929) closed form or the sum over waves; pivots move all
// nodes (Kostreva 1978), or one at a time if this cycles. It shares no code with the engine's solver. O(n³) a
// pivot: up to 24 x 24 cells.
#pragma once

#include <Eigen/Dense>
#include <limits>

#include "engine/contact/scene/boundary.hpp"
#include "engine/core/grid.hpp"

namespace asperity::stability {

struct DenseProblem {
  Grid grid;
  Boundary boundary = Boundary::periodic;
  double modulus = 1;                                          // E*, Pa
  Eigen::VectorXd heights;                                     // h, m, row by row
  double cap = std::numeric_limits<double>::infinity();        // H, Pa
  double yield = std::numeric_limits<double>::infinity();      // Y, Pa
  double hardening = std::numeric_limits<double>::infinity();  // K_h, Pa/m
};

struct DenseAnswer {
  Eigen::VectorXd pressure;  // Pa
  double offset = 0;         // δ, m: the gap is Kp − h − δ
  bool solved = false;       // all conditions hold to rounding
  int pivots = 0;
};

// u = K p, m per Pa.
Eigen::MatrixXd influence_matrix(const Grid& grid, Boundary boundary, double modulus);

DenseAnswer solve_densely(const DenseProblem& problem, double mean_pressure);

}  // namespace asperity::stability
