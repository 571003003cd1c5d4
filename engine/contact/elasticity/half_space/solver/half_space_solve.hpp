// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of an elastic half-space with a rough one under a mean pressure p̄:
//   minimise ½ p·Kp − h·p (+ Σ max(0, p − Y)²/(2K_h)) over 0 <= p <= H with mean p = p̄.
// h: combined heights, peaks up; K: compliance of the boundary (periodic: 2/(E*|q|), Johnson 1985 §13; free:
// Love 1929) or of a layer (elastic_layer.hpp). Only the certificate, from a fresh application of K, ends a
// solve. No friction, no adhesion, small slopes.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "engine/contact/certificate.hpp"
#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/scene/boundary.hpp"
#include "engine/contact/yield_law.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

enum class ChainEffort;

// Relative; above rounding, without effect on results.
inline constexpr double a_little = 1e-12;
// Pressures per modulus, or approaches per tile, below this leave the range of doubles.
inline constexpr double least_relative = 1e-280;

struct HalfSpaceProblem {
  Grid grid;
  Boundary boundary = Boundary::periodic;
  double modulus = 0;  // E*, Pa
  // A layer (periodic). K(0) affects only the approach under a load.
  std::optional<WaveShare> share{};
  // h, m. NaN: no counterpart (free tile only), no load.
  std::shared_ptr<const Field> heights;
  bool overhangs = false;  // some heights are NaN
  double rms = 0;          // of h about its mean, m; 0 for a flat
  YieldLaw yield;
  double tolerance = 1e-6;   // greatest entry of the certificate
  bool best_effort = false;  // returns the last iterate instead of throwing
  // Steps only; pressures, gaps and certificate stay double.
  bool single = false;
  bool brief = false;  // under pressure: skip the last resort
  double weight = 1;   // per transform counted; below 1 on coarser grids

  bool faces(std::size_t k) const { return !overhangs || !std::isnan((*heights)[k]); }
};

// In slabs: over all processes.
struct AnswerNumbers {
  double offset = 0;         // δ, m
  double mean_pressure = 0;  // Pa
  double approach = 0;       // m, max h + δ
  std::int64_t contacts = 0;
  std::int64_t yielded = 0;  // at the cap or above the yield pressure
  double peak_pressure = 0;  // Pa
  // With hardening, penetration and complementarity of g + w.
  Certificate certificate;
  bool converged = false;
  int iterations = 0;  // applications of K on the finest grid
  std::string solver;
};

struct HalfSpaceAnswer : AnswerNumbers {
  Field pressure;  // Pa; exactly 0 and exactly the cap at the bounds
  // m, Kp − h − δ: 0 where 0 < p < limit, >= 0 where p = 0, −w where yielded; undefined where h is NaN
  Field gap;
};

// K(0), m/Pa; 0 without a layer.
double uniform_compliance(const HalfSpaceProblem& problem);

// K in cell units; `with_mean` includes K(0).
ComplianceMultiplier multiplier_of(const HalfSpaceProblem& problem, bool with_mean = false);

// Mean pressure over all nodes. p̄ = 0: first touch, p = 0, δ = −max h. `start`: null, or an answer on any
// cells of the tile. About 20 to 40 applications of K, ten fields of memory. The certificate measures gaps by
// the rms height, or by p̄√area/E* for flat heights. Same bits for any number of threads. Throws
// Error{infeasible} if p̄ >= cap, {bad_value} if p̄ is negative, not finite or in (0, 1e-280 moduli),
// {not_converged} unless best_effort, {interrupted}.
HalfSpaceAnswer solve_at_pressure(const HalfSpaceProblem& problem, double mean_pressure,
                                  const HalfSpaceAnswer* start, Monitor& monitor);

// Periodic full elastic contact by the exact filter alone; residuals above the tolerance are rounding.
// Otherwise returns only the number of applications (at most two).
HalfSpaceAnswer solve_if_full(const HalfSpaceProblem& problem, double mean_pressure, Monitor& monitor);

// Depth of nodes without a counterpart below the lowest other, m: twice the sum of peak-to-valley and
// displacement of a node under the whole load.
double out_of_reach(const HalfSpaceProblem& problem, double mean_pressure);

// At an approach > 0. Gaps are measured by the least of `length` [m], rms height and approach. `start` (or
// null; same grid; overwritten): pressures, possibly out of bounds, and gaps at its approach. `effort` brief
// takes gaps and certificate from the last step. Never throws {not_converged}: on failure `converged` is
// false or all nodes are at the cap.
HalfSpaceAnswer solve_at_offset(const HalfSpaceProblem& problem, double approach, double length,
                                HalfSpaceAnswer* start, ChainEffort effort, Monitor& monitor);

// Σ p, extremes of p, Σ p (g − min g) or its form with a cap, least gap where p < cap.
struct PressureSums {
  double nodes = 0, load = 0, least = 0, greatest = 0, complementarity = 0, least_gap = 0;
};
// `cap` may be infinite; `length` 0: gaps in metres.
Certificate certificate_of(const PressureSums& sums, double mean_pressure, double cap, double length);

void certify(const HalfSpaceProblem& problem, HalfSpaceAnswer& answer);

// Residual of rounding in gaps: `lengths` [m] in total, per `rms` [m], times `weight` (cap / mean pressure,
// or 1). Seen: 63 roundings.
double rounding_residual(double lengths, double rms, double weight);

// Throws Error{not_converged}; the hint names rounding, or cells much longer than wide, as cause. `what`: the
// prescribed quantity. `rounding`: see rounding_residual().
[[noreturn]] void throw_unconverged(const std::string& what, const Certificate& reached, double tolerance,
                                    int applications, const Grid& grid, double rounding);

double rounding_residual(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer);

}  // namespace asperity
