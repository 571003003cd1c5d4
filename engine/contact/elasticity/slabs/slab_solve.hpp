// SPDX-License-Identifier: GPL-3.0-or-later
// The contact of a periodic elastic half-space with a rough one in slabs over a team of processes, none of
// which holds the whole grid: the problem, the certificate and the units of half_space/half_space_solve.hpp,
// with a cap on the pressure or none. Some 70 bytes a node over all processes, transforms included. All
// processes together; all get the same numbers, the same bits for the same number of processes.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "engine/contact/certificate.hpp"
#include "engine/contact/scene.hpp"
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
  Array<double> pressure;  // Pa, of this process; exactly 0 and exactly the cap at the bounds
  Array<double> gap;  // m, of this process: 0 where 0 < p < cap, >= 0 where p = 0, −w where p is the cap
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

// Throws as solve_at_pressure; also what one of the processes met with.
SlabContactAnswer solve_slabs_at_pressure(Team& team, const SlabContactProblem& problem, double mean_pressure,
                                          const SlabContactAnswer* start, Monitor& monitor);

// approach in m from first touch. The load that gives it, as a bracketed root, sought on a coarser grid
// first; the certificate's load entry is the relative error of the approach. Throws Error{infeasible} where
// no load does.
SlabContactAnswer solve_slabs_at_approach(Team& team, const SlabContactProblem& problem, double approach,
                                          Monitor& monitor);

// What materials and effects make of a contact in slabs under a flat, asked of the same code as for a contact
// in one process.
struct SlabTerms {
  double modulus = 0;  // E*, Pa
  double cap = 0;      // Pa; infinite where nothing yields
};

// Throws Error{bad_state} naming effect, body and property where a material lacks one; {bad_value} for
// hardening, which is not computed in slabs.
SlabTerms slab_terms(const std::optional<Material>& lower, const Material& upper, const Effects& effects);

}  // namespace asperity
