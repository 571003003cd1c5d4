// SPDX-License-Identifier: GPL-3.0-or-later
// A small half-space contact solved directly: a dense influence matrix, from Love's (1929) closed form or
// from the plain sum over waves, and pivots over which bound each node is at, every one a dense linear solve:
// all nodes at once (Kostreva 1978), and where that goes round in circles the active-set method of convex
// quadratic programmes. It shares nothing with the engine's solver but the statement of the problem: minimise
// ½ p·Kp − h·p + Σ max(0, p − Y)²/(2K_h) over 0 <= p <= H with a given mean. O(n³) a pivot: tiles up to 24
// x 24.
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
  double offset = 0;         // δ, m: Kp − h − δ is the gap
  bool solved = false;       // every condition holds to rounding
  int pivots = 0;
};

// u = K p, m per Pa.
Eigen::MatrixXd influence_matrix(const Grid& grid, Boundary boundary, double modulus);

DenseAnswer solve_densely(const DenseProblem& problem, double mean_pressure);

}  // namespace asperity::stability
