// SPDX-License-Identifier: GPL-3.0-or-later
// Half-space problems, and contact conditions by dense sums that share no code with the solver.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::half_space_test {

inline double rms_of(const Field& h) {
  const double middle = mean(h.values());
  double sum = 0;
  for (const double z : h.values()) sum += (z - middle) * (z - middle);
  return std::sqrt(sum / static_cast<double>(h.size()));
}

inline HalfSpaceProblem problem_of(const Grid& grid, Field heights, Boundary boundary, double modulus = 1,
                                   double tolerance = 1e-8) {
  HalfSpaceProblem problem;
  problem.grid = grid;
  problem.boundary = boundary;
  problem.modulus = modulus;
  problem.rms = rms_of(heights);
  problem.heights = std::make_shared<const Field>(std::move(heights));
  problem.tolerance = tolerance;
  return problem;
}

// Heights z(x, y).
inline HalfSpaceProblem problem_from(const Grid& grid, Boundary boundary,
                                     const std::function<double(double, double)>& height, double modulus = 1,
                                     double tolerance = 1e-8) {
  Field h(grid.nx, grid.ny);
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) h(i, j) = height(i * grid.hx(), j * grid.hy());
  return problem_of(grid, std::move(h), boundary, modulus, tolerance);
}

// Hurst 0.8, roll-off = long wave = tile, shortest wave 16 cells, rms slope 0.1, E* = 1.
inline HalfSpaceProblem rough_problem(int n, Boundary boundary, std::uint64_t seed, double tolerance = 1e-8) {
  SelfAffineOptions options = test::self_affine(make_grid(n, n, 1, 1), 0.8, 16.0 / n, seed);
  options.rms_slope = 0.1;
  return problem_of(options.grid, self_affine_surface(options).heights(), boundary, 1, tolerance);
}

inline HalfSpaceAnswer solve(const HalfSpaceProblem& problem, double pressure,
                             const HalfSpaceAnswer* start = nullptr) {
  return solve_at_pressure(problem, pressure, start, Monitor::silent());
}

inline double area_fraction(const HalfSpaceAnswer& answer) {
  return static_cast<double>(answer.contacts) / static_cast<double>(answer.pressure.size());
}
inline double mean_gap(const HalfSpaceAnswer& answer) {
  double sum = 0;
  for (const double g : answer.gap.values()) sum += std::max(0.0, g);
  return sum / static_cast<double>(answer.gap.size());
}
// ½ mean(p u), u = g + δ + h.
inline double mean_energy(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer) {
  double sum = 0;
  for (std::size_t k = 0; k < answer.gap.size(); ++k)
    sum += answer.pressure[k] * (answer.gap[k] + answer.offset + (*problem.heights)[k]);
  return 0.5 * sum / static_cast<double>(answer.gap.size());
}
// Between touching and open nodes; across the rim on a periodic tile.
inline double contact_edges(const HalfSpaceAnswer& answer, bool periodic) {
  const Field& p = answer.pressure;
  const int nx = p.nx(), ny = p.ny();
  double edges = 0;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const bool here = p(i, j) > 0;
      if (i + 1 < nx || periodic) edges += here != (p((i + 1) % nx, j) > 0);
      if (j + 1 < ny || periodic) edges += here != (p(i, (j + 1) % ny) > 0);
    }
  return edges;
}

// u = K p by a dense sum: Love's coefficients (free) or waves (periodic).
inline std::vector<double> dense_displacement(const HalfSpaceProblem& problem, const Field& p) {
  const int nx = problem.grid.nx, ny = problem.grid.ny;
  const double hx = problem.grid.hx(), hy = problem.grid.hy();
  auto love = [&](double x, double y) {
    auto corner = [](double a, double b) {
      const double r = std::hypot(a, b);
      return a * std::log(b + r) + b * std::log(a + r);
    };
    const double a = x + hx / 2, b = x - hx / 2, c = y + hy / 2, d = y - hy / 2;
    return (corner(a, c) + corner(b, d) - corner(a, d) - corner(b, c)) / (std::numbers::pi * problem.modulus);
  };
  auto waves = [&](int i, int j) {
    double sum = 0;
    for (int b = 0; b < ny; ++b)
      for (int a = 0; a < nx; ++a) {
        if (a == 0 && b == 0) continue;
        const double qx = 2 * std::numbers::pi * std::min(a, nx - a) / problem.grid.size_x;
        const double qy = 2 * std::numbers::pi * std::min(b, ny - b) / problem.grid.size_y;
        sum += 2 / (problem.modulus * std::hypot(qx, qy)) *
               std::cos(2 * std::numbers::pi *
                        (static_cast<double>(a) * i / nx + static_cast<double>(b) * j / ny));
      }
    return sum / (static_cast<double>(nx) * ny);
  };
  const bool free = problem.boundary == Boundary::free;
  Field kernel(nx, ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) kernel(i, j) = free ? love(i * hx, j * hy) : waves(i, j);
  std::vector<double> u(p.size());
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      double sum = 0;
      for (int m = 0; m < ny; ++m)
        for (int l = 0; l < nx; ++l)
          sum += p(l, m) * (free ? kernel(std::abs(i - l), std::abs(j - m))
                                 : kernel((i - l + nx) % nx, (j - m + ny) % ny));
      u[static_cast<std::size_t>(j) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(i)] = sum;
    }
  return u;
}

// Largest violation of the contact conditions, gaps relative to the rms height. The problem is convex: a
// small value is a proof.
inline double dense_violation(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer) {
  const std::vector<double> u = dense_displacement(problem, answer.pressure);
  const YieldLaw& law = problem.yield;
  const double cap = law.caps() ? law.cap : std::numeric_limits<double>::infinity();
  double worst = 0, load = 0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    const double p = answer.pressure[k];
    double g = u[k] - (*problem.heights)[k] - answer.offset;
    if (law.hardens()) g += std::max(0.0, p - (law.yield ? (*law.yield)[k] : law.cap)) / law.hardening;
    load += p;
    if (p < 0 || p > cap) return std::numeric_limits<double>::infinity();
    const double violation = p == 0 ? std::max(0.0, -g) : p == cap ? std::max(0.0, g) : std::abs(g);
    worst = std::max(worst, violation / problem.rms);
  }
  const double n = static_cast<double>(u.size());
  return std::max(worst, std::abs(load / n / answer.mean_pressure - 1));
}

}  // namespace asperity::half_space_test
