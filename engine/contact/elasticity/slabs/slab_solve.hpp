// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of a periodic half-space in slabs over a team of processes: problem, certificate and units of
// half_space/half_space_solve.hpp. About 70 bytes a node over all processes, transforms included. All
// processes call together and get the same numbers; bits depend on the number of processes.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "engine/contact/certificate.hpp"
#include "engine/contact/scene/scene.hpp"
#include "engine/core/monitor.hpp"
#include "engine/surface/slabs/slab_surface.hpp"

namespace asperity {

struct SlabContactProblem {
  SlabSurface surface;                                   // of the combined heights
  double modulus = 0;                                    // E*, Pa
  double cap = std::numeric_limits<double>::infinity();  // Pa
  double tolerance = 1e-6;
  bool best_effort = false;
};

struct SlabContactAnswer {
  Array<double> pressure;     // Pa, of this process; exactly 0 and exactly the cap at the bounds
  Array<double> gap;          // m, of this process; 0 where 0 < p < cap, >= 0 at p = 0, −w at the cap
  double mean_pressure = 0;   // Pa
  double approach = 0;        // m
  double offset = 0;          // m
  std::int64_t contacts = 0;  // nodes with p > 0
  std::int64_t yielded = 0;   // nodes at the cap
  double peak_pressure = 0;   // Pa
  double mean_gap = 0;        // m, of max(gap, 0)
  double energy = 0;          // J in the tile
  double plastic_volume = 0;  // m³
  Certificate certificate;
  bool converged = false;
  int iterations = 0;  // applications of K on the finest grid
  std::string solver;
};

// Throws as solve_at_pressure, in all processes.
SlabContactAnswer solve_slabs_at_pressure(Team& team, const SlabContactProblem& problem, double mean_pressure,
                                          const SlabContactAnswer* start, Monitor& monitor);

// approach in m from first touch. certificate.load is the relative error of the approach. Throws
// Error{infeasible} if no load gives the approach.
SlabContactAnswer solve_slabs_at_approach(Team& team, const SlabContactProblem& problem, double approach,
                                          Monitor& monitor);

// From the same code as a contact in one process; the upper body is a flat.
struct SlabTerms {
  double modulus = 0;  // E*, Pa
  double cap = 0;      // Pa; infinite without yielding
};

// Throws Error{bad_state} naming effect, body and missing property; {bad_value} for hardening.
SlabTerms slab_terms(const std::optional<Material>& lower, const Material& upper, const Effects& effects);

}  // namespace asperity
