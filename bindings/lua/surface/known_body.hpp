// SPDX-License-Identifier: GPL-3.0-or-later
// Known facts about a surface that a dry run does not make: material and, from the call, cells and size. The
// dry run refuses contacts as the run does.
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

// Null if unknown.
std::shared_ptr<const KnownBody> known_body(const Argument& value);

// From the call's options and the surface before the colon; null if unknown.
std::shared_ptr<const KnownBody> known_result(const Call& call, const Function& function);

// For trial scenes: small, of this material and any known size.
Surface stand_in(const KnownBody& body);

}  // namespace asperity::lua
