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

struct HalfSpaceProblem {
  Grid grid;
  Boundary boundary = Boundary::periodic;
  double modulus = 0;  // E*, Pa
  // A layer on a periodic tile. Its K(0) affects only the approach under a load.
  std::optional<WaveShare> share{};
  // h, m. NaN marks nodes without a counterpart (free tile only); such nodes never carry load.
  std::shared_ptr<const Field> heights;
  bool overhangs = false;  // some heights are NaN
  double rms = 0;          // of h about its mean, m; 0 for a flat
  YieldLaw yield;
  double tolerance = 1e-6;   // greatest entry of the certificate
  bool best_effort = false;  // return the last iterate instead of throwing
  // Steps are in single precision; pressures, gaps and certificate stay double.
  bool single = false;
  bool brief = false;  // under a mean pressure: skip the last resort
  double weight = 1;   // per transform in the count; below 1 on coarser grids

  bool faces(std::size_t k) const { return !overhangs || !std::isnan((*heights)[k]); }
};

struct HalfSpaceAnswer {
  Field pressure;  // Pa; exactly 0 and exactly the cap at the bounds
  // m, Kp − h − δ: 0 where 0 < p < limit, >= 0 where p = 0, −w at yielded nodes; meaningless where h is NaN
  Field gap;
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

// K(0), m/Pa; 0 without a layer.
double uniform_compliance(const HalfSpaceProblem& problem);

// K in cell units; `with_mean` includes K(0).
ComplianceMultiplier multiplier_of(const HalfSpaceProblem& problem, bool with_mean = false);

// Contact under a mean pressure (over all nodes). p̄ = 0: first touch, p = 0, δ = −max h. `start`: null, or
// an answer on the same or other cells of the tile. Costs about 20 to 40 applications of K and ten fields of
// memory. The certificate measures gaps by the rms height, or by p̄√area/E* for flat heights. Same bits for
// any number of threads. Throws Error{infeasible} if p̄ >= cap, {bad_value} if p̄ is negative, not finite or
// positive but below 1e-280 of the modulus, {not_converged} unless best_effort, {interrupted}.
HalfSpaceAnswer solve_at_pressure(const HalfSpaceProblem& problem, double mean_pressure,
                                  const HalfSpaceAnswer* start, Monitor& monitor);

// Full elastic contact of a periodic tile by the exact filter alone; a residual above the tolerance is
// rounding. Returns only the number of applications (at most two) if the tile is not in full contact.
HalfSpaceAnswer solve_if_full(const HalfSpaceProblem& problem, double mean_pressure, Monitor& monitor);

// Depth of nodes without a counterpart below the lowest other node, m: twice the peak-to-valley and twice the
// displacement of a single node under the whole load.
double out_of_reach(const HalfSpaceProblem& problem, double mean_pressure);

// u = Kp of both bodies, m. One application.
Field displacement_under(const HalfSpaceProblem& problem, const Field& pressure);

// Contact at an approach > 0; returns the mean pressure found. Gaps are measured by the least of `length`
// [m], rms height and approach. `start` (or null; same grid; overwritten): pressures, possibly outside their
// bounds, and gaps at its approach. `effort` brief takes gaps and certificate from the last step. Never
// throws {not_converged}: without a solution `converged` is false or all nodes are at the cap.
HalfSpaceAnswer solve_at_offset(const HalfSpaceProblem& problem, double approach, double length,
                                HalfSpaceAnswer* start, ChainEffort effort, Monitor& monitor);

// Over all nodes: Σ p, extremes of p, Σ p (g − min g) or its form with a cap, least gap where p < cap.
struct PressureSums {
  double nodes = 0, load = 0, least = 0, greatest = 0, complementarity = 0, least_gap = 0;
};
// `cap` may be infinite, `length` 0: gaps are then in metres.
Certificate certificate_of(const PressureSums& sums, double mean_pressure, double cap, double length);

// Recomputes counts and certificate. O(n).
void certify(const HalfSpaceProblem& problem, HalfSpaceAnswer& answer);

// Residual that rounding can leave in gaps: `lengths` [m] in total, per `rms` [m], times `weight` (cap /
// mean pressure, or 1). Seen: 63 roundings.
double rounding_residual(double lengths, double rms, double weight);

// Throws Error{not_converged}. `rounding`: see rounding_residual().
[[noreturn]] void throw_unconverged(double mean_pressure, const Certificate& reached, double tolerance,
                                    int applications, const Grid& grid, double rounding);

// Names rounding if it explains `reached`, or cells much longer than wide.
std::string unconverged_hint(const Grid& grid, double reached, double rounding);

double rounding_residual(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer);

}  // namespace asperity
