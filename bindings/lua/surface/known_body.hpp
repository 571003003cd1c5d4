// SPDX-License-Identifier: GPL-3.0-or-later
// What a dry run knows of a surface that it does not make: its material and, where the call names them,
// its cells and size. A placeholder carries this along, so that a contact of such bodies can be refused
// before the run for what it would be refused for in the run.
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
  std::optional<Material> material;  // none: the surface has none
  std::optional<Grid> grid;          // none: not known before the run
};

// Of a surface or its placeholder; null where nothing is known.
std::shared_ptr<const KnownBody> known_body(const Argument& value);

// Of the surface that this call would give, from its own table and the surface that it is called on; null
// where nothing is known.
std::shared_ptr<const KnownBody> known_result(const Call& call, const Function& function);

// A small surface of this material, and of this size where it is known, to try a scene with.
Surface stand_in(const KnownBody& body);

}  // namespace asperity::lua
