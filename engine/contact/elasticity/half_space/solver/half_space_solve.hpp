// SPDX-License-Identifier: GPL-3.0-or-later
// The contact of an elastic half-space with a rough one under a prescribed mean pressure p̄: minimise
// ½ p·Kp − h·p (+ Σ max(0, p − Y)²/(2K_h)) over 0 <= p <= H with mean p = p̄, K the compliance of the
// boundary (periodic: 2/(E*|q|), Johnson 1985 §13; free: Love 1929) or of a layer (elastic_layer.hpp), h the
// combined heights, peaks up. Solved on nested grids by projected, preconditioned descents, and finished only
// by the certificate of the pressures and gaps handed out, evaluated with a fresh application of K. Full
// contact is an exact filter. No friction, no adhesion; half-space slopes are taken as small.
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
  // In place of the half-space, on a periodic tile. Pressures and gaps under a load know nothing of its K(0).
  std::optional<WaveShare> share{};
  // h, m. On a free tile it may be missing (NaN) where nothing faces the ground, which then never carries.
  std::shared_ptr<const Field> heights;
  bool overhangs = false;  // whether it is missing anywhere
  double rms = 0;          // of h about its mean, m; 0 for a flat
  YieldLaw yield;
  double tolerance = 1e-6;   // greatest entry of the certificate
  bool best_effort = false;  // hand out what was reached instead of throwing
  // What steps change is computed in single precision, where the grid allows, on any grid and with the memory
  // for that alone; pressures, gaps and the certificate are double all the same.
  bool single = false;
  bool brief = false;  // under a mean pressure: without the last resort, and perhaps without success
  double weight = 1;   // of one transform in what is counted: less on a grid coarser than the one asked for

  // Whether something faces the ground at node k.
  bool faces(std::size_t k) const { return !overhangs || !std::isnan((*heights)[k]); }
};

struct HalfSpaceAnswer {
  Field pressure;  // Pa; exactly 0 and exactly the cap at the bounds
  // m, Kp − h − δ: 0 where 0 < p < limit, >= 0 where p = 0, −w where it yielded; above zero, and no more to
  // be said of it, where h is missing
  Field gap;
  double offset = 0;          // δ, m
  double mean_pressure = 0;   // Pa, as prescribed
  double approach = 0;        // m, max h + δ
  std::int64_t contacts = 0;  // nodes with p > 0
  std::int64_t yielded = 0;   // nodes at the cap, or past their yield pressure
  double peak_pressure = 0;   // Pa
  // Hardening: complementarity and penetration of the gap with w added back, g + w.
  Certificate certificate;
  bool converged = false;
  int iterations = 0;  // applications of K on the finest grid
  std::string solver;  // the stage that finished
};

// K(0), m/Pa: what the tile sinks under a uniform pressure, all of it the same; 0 but on a layer.
double uniform_compliance(const HalfSpaceProblem& problem);

// K in cell units, with K(0) or without.
ComplianceMultiplier multiplier_of(const HalfSpaceProblem& problem, bool with_mean = false);

// Heights that are all equal, or differ by rounding alone, have no rms; the certificate then takes p̄√area/E*
// for its length, about what the tile would sink as one punch.
// Means of pressures are over all nodes of the tile. Ground that nothing faces is put deeper than a load of
// all nodes on any one of them could reach, and never enters the contact.
// Costs a fixed number of O(n log n) applications of K (some 20 to 40) and holds about ten fields besides
// the answer. A null `start` begins from nested grids; otherwise from the pressures of `start`, a
// nearby answer on these or other cells of the tile. Throws Error{infeasible} where p̄ >= cap, {bad_value}
// where p̄ is negative, not finite or below 1e-280 of the modulus, {not_converged} unless best_effort,
// {interrupted} and the like when asked to stop. p̄ = 0 is the first touch: no pressure, δ = −max h. Same bits
// for any number of threads.
HalfSpaceAnswer solve_at_pressure(const HalfSpaceProblem& problem, double mean_pressure,
                                  const HalfSpaceAnswer* start, Monitor& monitor);

// The same where all of a periodic tile touches and nothing yields, by the exact filter alone, converged or
// not: what it lacks of the tolerance is rounding. Where that is not so, no pressures, only the count of
// applications, two at most.
HalfSpaceAnswer solve_if_full(const HalfSpaceProblem& problem, double mean_pressure, Monitor& monitor);

// How far ground that nothing faces is put below the lowest that something does, m: as bodies with Σ p of
// `mean_pressure` over all nodes come no nearer than u + w at the one node that carries it all, twice that
// and twice the peak-to-valley is out of reach.
double out_of_reach(const HalfSpaceProblem& problem, double mean_pressure);

// u = K p of both bodies, m, where something faces the ground and where nothing does. One application.
Field displacement_under(const HalfSpaceProblem& problem, const Field& pressure);

// The same contact at a given approach > 0, whatever load that takes: the answer's mean pressure is what was
// found. `length`: the least that gaps must be told apart by, in m; the rms and the approach count besides.
// `start`, if not null and on the same grid: pressures to begin from, outside their bounds if need be, and
// their gaps at its approach; what it holds is spent. `effort`: brief, quick or full (descent.hpp); brief
// takes gaps and certificate from the steps that led to the pressures. Does not throw for lack of
// convergence; of a periodic half-space in full contact without yield, or of a tile whose nodes are all at
// the cap, there is no such answer, and `converged` is false or all nodes are at the cap.
HalfSpaceAnswer solve_at_offset(const HalfSpaceProblem& problem, double approach, double length,
                                HalfSpaceAnswer* start, ChainEffort effort, Monitor& monitor);

// What a certificate is made of, of all nodes: Σ p, least and greatest p, Σ p (g − min g) or what a cap makes
// of it, and the least gap where p is below the cap (infinite: nowhere).
struct PressureSums {
  double nodes = 0, load = 0, least = 0, greatest = 0, complementarity = 0, least_gap = 0;
};
// `cap` may be infinite; `length`, what gaps are measured by, 0.
Certificate certificate_of(const PressureSums& sums, double mean_pressure, double cap, double length);

// Counts, peak pressure and certificate anew, of the pressures and gaps that `answer` holds. O(n).
void certify(const HalfSpaceProblem& problem, HalfSpaceAnswer& answer);

// The residual below which rounding may hide the rest: gaps are differences of heights and displacements, the
// greatest of them `lengths` [m] together, are measured by `rms` [m], and count `weight` times (the cap by
// the mean pressure; 1 without a cap). Measured at the solver's end over random scenes: up to 63 roundings.
double rounding_residual(double lengths, double rms, double weight);

// Throws Error{not_converged}: what was reached under the mean pressure [Pa] after so many applications of
// the half-space, and what would work. `rounding`: the residual that rounding may leave.
[[noreturn]] void throw_unconverged(double mean_pressure, const Certificate& reached, double tolerance,
                                    int applications, const Grid& grid, double rounding);

// What would work where a residual was reached: names rounding where that is no more than rounding leaves,
// and cells that are much longer than wide, which converge badly.
std::string unconverged_hint(const Grid& grid, double reached, double rounding);

// The residual that rounding may leave of an answer under a mean pressure [Pa].
double rounding_residual(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer);

}  // namespace asperity
