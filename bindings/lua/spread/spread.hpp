// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces, contacts and states in slabs over the ranks of mpirun, as native values of the language; in a
// process alone the same with one slab.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "bindings/lua/registry/registry.hpp"
#include "engine/contact/elasticity/slabs/slab_solve.hpp"
#include "engine/contact/scene/scene.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/files/result_store.hpp"
#include "engine/core/slabs/team.hpp"
#include "engine/surface/slabs/slab_surface.hpp"

namespace asperity::lua {

// The ranks, all of which have come to this call; or this process alone. Throws Error{bad_state} where
// another rank does something else, {not_permitted} in a case of an ensemble.
Team& team_of(const Call& call);

struct SpreadContact {
  SlabContactProblem problem;
  bool plastic = false;  // the scene names plasticity
};

// What a press was asked for: `value` is an approach in m, or a mean pressure in Pa.
struct SpreadRequest {
  bool by_approach = false;
  double value = 0;
};
SlabContactAnswer solve(Team& team, const SlabContactProblem& problem, const SpreadRequest& request,
                        Monitor& monitor);

// A press that the run's store holds: its numbers, without the fields, in all ranks; they are solved for
// again where a script writes them. Rank 0 looks, and keeps.
std::optional<Costed<SlabContactAnswer>> recalled_press(const Call& call, Team& team,
                                                        const SlabContactProblem& problem,
                                                        const SpreadRequest& request);
void keep_press(const Call& call, const SlabContactProblem& problem, const SpreadRequest& request,
                const Costed<SlabContactAnswer>& found);

struct SpreadState {
  SlabSurface surface;
  std::shared_ptr<const SlabContactAnswer> answer;
  SlabContactProblem problem;  // that it solves
  SpreadRequest request;
  bool has_fields = true;
  bool plastic = false;
  int ranks = 1;
  Cost cost;           // of bytes the most that a rank held at once, heights included
  std::string digest;  // of the numbers below
};

template <>
const Class& class_of<SlabSurface>();
template <>
const Class& class_of<SpreadContact>();
template <>
const Class& class_of<SpreadState>();

// lab.spread.contact.
Function spread_contact_function();

}  // namespace asperity::lua
