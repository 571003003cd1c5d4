// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts in slabs over MPI ranks, one slab a process.
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

// Collective. Throws Error{bad_state} if another rank makes another call, {not_permitted} in a case.
Team& team_of(const Call& call);

struct SpreadContact {
  SlabContactProblem problem;
  bool plastic = false;
};

// `value` in m or Pa (mean pressure).
struct SpreadRequest {
  bool by_approach = false;
  double value = 0;
};
SlabContactAnswer solve(Team& team, const SlabContactProblem& problem, const SpreadRequest& request,
                        Monitor& monitor);

// A stored press, without fields (writing them solves again), on all ranks. Only rank 0 uses the store.
std::optional<Costed<SlabContactAnswer>> recalled_press(const Call& call, Team& team,
                                                        const SlabContactProblem& problem,
                                                        const SpreadRequest& request);
void keep_press(const Call& call, const SlabContactProblem& problem, const SpreadRequest& request,
                const Costed<SlabContactAnswer>& found);

struct SpreadState {
  SlabSurface surface;
  std::shared_ptr<const SlabContactAnswer> answer;
  SlabContactProblem problem;  // solved by this state
  SpreadRequest request;
  bool has_fields = true;
  bool plastic = false;
  int ranks = 1;
  Cost cost;           // bytes: peak of a rank, with heights
  std::string digest;  // of the numbers below
};

Class make_class(For<SlabSurface>);
Class make_class(For<SpreadContact>);
Class make_class(For<SpreadState>);

Function spread_contact_function();

}  // namespace asperity::lua
