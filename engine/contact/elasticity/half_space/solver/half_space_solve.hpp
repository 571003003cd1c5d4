// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of an elastic half-space with a rough one under a mean pressure p̄: minimise ½ p·Kp − h·p (+ Σ
// max(0, p − Y)²/(2K_h)) over 0 <= p <= H with mean p = p̄. h: combined heights, peaks up. K: compliance of
// the boundary (periodic: 2/(E*|q|), Johnson 1985 §13; free: Love 1929) or of a layer (elastic_layer.hpp).
// Nested grids and projected, preconditioned descents; only the certificate of the returned pressures and
// gaps, from a fresh application of K, ends a solve. No friction, no adhesion, small slopes.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "engine/contact/boundary.hpp"
#include "engine/contact/certificate.hpp"
#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/yield_law.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

enum class ChainEffort;  // descent.hpp

struct HalfSpaceProblem {
  Grid grid;
  Boundary boundary = Boundary::periodic;
  double modulus = 0;  // E*, Pa
  // A layer instead of a half-space, on a periodic tile. K(0) of the layer does not affect pressures and
  // gaps under a load.
  std::optional<WaveShare> share{};
  // h, m. On a free tile NaN marks nodes without a counterpart; such nodes never carry load.
  std::shared_ptr<const Field> heights;
  bool overhangs = false;  // some heights are NaN
  double rms = 0;          // of h about its mean, m; 0 for a flat
  YieldLaw yield;
  double tolerance = 1e-6;   // greatest entry of the certificate
  bool best_effort = false;  // return the last iterate instead of throwing
  // Compute the changes of pressures and gaps in single precision on grids large enough, with less memory.
  // Pressures, gaps and certificate stay double.
  bool single = false;
  bool brief = false;  // under a mean pressure: skip the last resort; the solve may fail
  double weight = 1;   // of one transform in the count; below 1 on coarser grids

  bool faces(std::size_t k) const { return !overhangs || !std::isnan((*heights)[k]); }
};

struct HalfSpaceAnswer {
  Field pressure;  // Pa; exactly 0 and exactly the cap at the bounds
  // m, Kp − h − δ: 0 where 0 < p < limit, >= 0 where p = 0, −w at yielded nodes; positive but meaningless
  // where h is NaN
  Field gap;
  double offset = 0;          // δ, m
  double mean_pressure = 0;   // Pa, as prescribed
  double approach = 0;        // m, max h + δ
  std::int64_t contacts = 0;  // nodes with p > 0
  std::int64_t yielded = 0;   // nodes at the cap or above their yield pressure
  double peak_pressure = 0;   // Pa
  // With hardening: complementarity and penetration of g + w.
  Certificate certificate;
  bool converged = false;
  int iterations = 0;  // applications of K on the finest grid
  std::string solver;  // last stage
};

// K(0), m/Pa: uniform displacement per uniform pressure; 0 without a layer.
double uniform_compliance(const HalfSpaceProblem& problem);

// K in cell units; `with_mean` includes K(0).
ComplianceMultiplier multiplier_of(const HalfSpaceProblem& problem, bool with_mean = false);

// Contact under a mean pressure, averaged over all nodes. Costs about 20 to 40 applications of K, O(n log n)
// each, and about ten fields of memory. `start` null: nested grids; otherwise a nearby answer on the same or
// other cells of the tile. p̄ = 0: first touch, p = 0, δ = −max h. The certificate measures gaps by the rms
// height, or by p̄√area/E* if all heights are equal up to rounding. Nodes without a counterpart are placed
// so deep that they never touch. The result has the same bits for any number of threads. Throws
// Error{infeasible} if p̄ >= cap, {bad_value} if p̄ is negative, not finite or positive but below 1e-280 of
// the modulus, {not_converged} unless best_effort, {interrupted}.
HalfSpaceAnswer solve_at_pressure(const HalfSpaceProblem& problem, double mean_pressure,
                                  const HalfSpaceAnswer* start, Monitor& monitor);

// Full elastic contact of a periodic tile by the exact filter alone. `converged` may be false; the excess
// over the tolerance is then rounding. If the tile is not in full elastic contact, returns only the number
// of applications (at most two).
HalfSpaceAnswer solve_if_full(const HalfSpaceProblem& problem, double mean_pressure, Monitor& monitor);

// Depth of nodes without a counterpart below the lowest node that has one, m: twice the peak-to-valley plus
// twice the u + w of one node that carries the whole load `mean_pressure` · nodes.
double out_of_reach(const HalfSpaceProblem& problem, double mean_pressure);

// u = Kp of both bodies at every node, m. One application.
Field displacement_under(const HalfSpaceProblem& problem, const Field& pressure);

// Contact at an approach > 0; the answer contains the mean pressure found. Gaps are measured by the smallest
// of `length` [m], rms height and approach. `start` (may be null; same grid): pressures, possibly outside
// their bounds, and gaps at its approach; its fields are overwritten. `effort`: brief, quick, less or full
// (descent.hpp); brief takes gaps and certificate from the last step without a fresh application. Does not
// throw if the descent fails: without a solution (elastic full contact of a periodic half-space, or all
// nodes at the cap), `converged` is false or all nodes are at the cap.
HalfSpaceAnswer solve_at_offset(const HalfSpaceProblem& problem, double approach, double length,
                                HalfSpaceAnswer* start, ChainEffort effort, Monitor& monitor);

// Sums and extremes over all nodes for a certificate: Σ p, least and greatest p, Σ p (g − min g) (with a
// cap: its capped form), least gap where p is below the cap (infinite: nowhere).
struct PressureSums {
  double nodes = 0, load = 0, least = 0, greatest = 0, complementarity = 0, least_gap = 0;
};
// `cap` may be infinite. `length` = 0: gaps are not divided by a length.
Certificate certificate_of(const PressureSums& sums, double mean_pressure, double cap, double length);

// Recomputes counts, peak pressure and certificate from the pressures and gaps of `answer`. O(n).
void certify(const HalfSpaceProblem& problem, HalfSpaceAnswer& answer);

// Residual that rounding can leave. Gaps are differences of lengths whose magnitudes sum to `lengths` [m],
// divided by `rms` [m] and multiplied by `weight` (cap / mean pressure; 1 without a cap). Largest error in
// random scenes: 63 roundings.
double rounding_residual(double lengths, double rms, double weight);

// Throws Error{not_converged} with the residual reached and a hint. `rounding`: residual that rounding can
// leave.
[[noreturn]] void throw_unconverged(double mean_pressure, const Certificate& reached, double tolerance,
                                    int applications, const Grid& grid, double rounding);

// Hint for the error: names rounding if `reached` is below `rounding`, or cells much longer than wide, which
// slow convergence.
std::string unconverged_hint(const Grid& grid, double reached, double rounding);

// Residual that rounding can leave in `answer`.
double rounding_residual(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer);

}  // namespace asperity
