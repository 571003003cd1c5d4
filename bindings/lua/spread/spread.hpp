// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces, contacts and states in slabs over MPI ranks, as native Lua values. A single process has one slab.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "bindings/lua/registry/registry.hpp"
#include "engine/contact/elasticity/slabs/slab_solve.hpp"
#include "engine/contact/scene.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/files/result_store.hpp"
#include "engine/core/slabs/team.hpp"
#include "engine/surface/slabs/slab_surface.hpp"

namespace asperity::lua {

// The ranks in this call, or this process alone. Collective. Throws Error{bad_state} if another rank makes
// another call, {not_permitted} in a case of an ensemble.
Team& team_of(const Call& call);

struct SpreadContact {
  SlabContactProblem problem;
  bool plastic = false;
};

// `value`: approach in m, or mean pressure in Pa.
struct SpreadRequest {
  bool by_approach = false;
  double value = 0;
};
SlabContactAnswer solve(Team& team, const SlabContactProblem& problem, const SpreadRequest& request,
                        Monitor& monitor);

// A press from the result store, without its fields, on all ranks. Writing fields solves the press again.
// Only rank 0 reads and writes the store.
std::optional<Costed<SlabContactAnswer>> recalled_press(const Call& call, Team& team,
                                                        const SlabContactProblem& problem,
                                                        const SpreadRequest& request);
void keep_press(const Call& call, const SlabContactProblem& problem, const SpreadRequest& request,
                const Costed<SlabContactAnswer>& found);

struct SpreadState {
  SlabSurface surface;
  std::shared_ptr<const SlabContactAnswer> answer;
  SlabContactProblem problem;  // that this state solves
  SpreadRequest request;
  bool has_fields = true;
  bool plastic = false;
  int ranks = 1;
  Cost cost;           // bytes: peak of one rank, heights included
  std::string digest;  // of the numbers below
};

template <>
const Class& class_of<SlabSurface>();
template <>
const Class& class_of<SpreadContact>();
template <>
const Class& class_of<SpreadState>();

Function spread_contact_function();

}  // namespace asperity::lua
