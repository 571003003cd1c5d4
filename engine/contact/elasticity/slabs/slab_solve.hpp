// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of a periodic half-space in slabs over a team of processes: problem, certificate and units of
// half_space/half_space_solve.hpp. About 70 bytes a node over all processes, transforms included. All
// processes call together and get the same numbers; bits depend on the number of processes.
#pragma once

#include <limits>
#include <optional>

#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"
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

struct SlabContactAnswer : AnswerNumbers {
  // The part of this process, Pa and m.
  UnsetArray<double> pressure, gap;
  double mean_gap = 0;        // m, of max(gap, 0)
  double energy = 0;          // J in the tile
  double plastic_volume = 0;  // m³
};

// Throws as solve_at_pressure, in all processes.
SlabContactAnswer solve_slabs_at_pressure(Team& team, const SlabContactProblem& problem, double mean_pressure,
                                          const SlabContactAnswer* start, Monitor& monitor);

// approach in m from first touch; certificate.load is its relative error. Throws Error{infeasible} if no load
// gives the approach.
SlabContactAnswer solve_slabs_at_approach(Team& team, const SlabContactProblem& problem, double approach,
                                          Monitor& monitor);

// As in one process; the upper body is a flat.
struct SlabTerms {
  double modulus = 0;  // E*, Pa
  double cap = 0;      // Pa; infinite without yielding
};

// Throws Error{bad_state} naming effect, body and property; {bad_value} for hardening.
SlabTerms slab_terms(const std::optional<Material>& lower, const Material& upper, const Effects& effects);

}  // namespace asperity
