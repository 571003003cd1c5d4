// SPDX-License-Identifier: GPL-3.0-or-later
// How `asperity accuracy` makes a script coarser or finer without changing its text: every `cells` that the
// script gives is multiplied by a factor, rounded to the nearest whole number and at least 1, and the
// tolerance of every contact is replaced. Surfaces from files and tables keep the cells they have. It
// also notes what the script used, so that the study knows what there is to vary.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <optional>

#include "bindings/lua/registry/lua_api.hpp"

namespace asperity::lua {

// Shared by the states of a run and of its ensembles' cases. Thread-safe.
struct Refinement {
  double cells_factor = 1;
  std::optional<double> tolerance;

  // What the script gave, as written.
  std::atomic<std::int64_t> grids{0};
  std::atomic<std::int64_t> contacts{0};
  std::atomic<double> tightest{std::numeric_limits<double>::infinity()};  // tolerance of a contact

  // What is made of a number of cells, and of a contact's tolerance, which are noted.
  std::int64_t cells(std::int64_t given);
  double tolerance_for(double given);
};

// That of the state's session; null where there is none.
Refinement* refinement_of(lua_State* L);

}  // namespace asperity::lua
