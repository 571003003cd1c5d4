// SPDX-License-Identifier: GPL-3.0-or-later
// Facts that a dry run knows about an unmade surface: material and, if the call gives them, cells and size. A
// placeholder carries the facts, so that a dry run refuses the same contacts as the run.
#pragma once

#include <memory>
#include <optional>

#include "bindings/lua/registry/argument.hpp"
#include "engine/core/grid.hpp"
#include "engine/surface/surface.hpp"

namespace asperity::lua {

class Call;
struct Function;

struct KnownBody {
  std::optional<Material> material;  // empty: no material
  std::optional<Grid> grid;          // empty: unknown before the run
};

// Facts of a surface or placeholder; null if unknown.
std::shared_ptr<const KnownBody> known_body(const Argument& value);

// Facts of the call's result, from its options and the surface before the colon; null if unknown.
std::shared_ptr<const KnownBody> known_result(const Call& call, const Function& function);

// A small surface of this material and, if known, size, for trial scenes.
Surface stand_in(const KnownBody& body);

}  // namespace asperity::lua
