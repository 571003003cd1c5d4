// SPDX-License-Identifier: GPL-3.0-or-later
// Grid refinement for `asperity accuracy` with the script unchanged: `cells` are multiplied by a factor and
// rounded, at least 1, and the tolerances of contacts replaced. Surfaces from files and tables keep their
// cells. Counters tell the study which quantities can vary.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <optional>

#include "bindings/lua/registry/lua_api.hpp"

namespace asperity::lua {

// Shared by a run and its cases. Thread-safe.
struct Refinement {
  double cells_factor = 1;
  std::optional<double> tolerance;

  // Counts and the smallest tolerance in the script.
  std::atomic<std::int64_t> grids{0};
  std::atomic<std::int64_t> contacts{0};
  std::atomic<double> tightest{std::numeric_limits<double>::infinity()};

  // Return the effective value and update the counters.
  std::int64_t cells(std::int64_t given);
  double tolerance_for(double given);
};

Refinement* refinement_of(lua_State* L);

}  // namespace asperity::lua
