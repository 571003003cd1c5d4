// SPDX-License-Identifier: GPL-3.0-or-later
// Fields over the nodes of a grid as native values of the language: what a state knows of each node, and
// which points of a surface were measured.
#pragma once

#include <memory>
#include <string>

#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/value.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/quantity.hpp"
#include "engine/plot/picture.hpp"

namespace asperity::lua {

// A field over a tile, with what it is.
struct NamedField {
  std::string name;
  Grid grid;
  std::shared_ptr<const Field> values;
  Dimension dimension;
};

template <>
const Class& class_of<NamedField>();

// The keys of a picture, shared by surfaces and fields.
const Block<PictureOptions>& picture_block();

}  // namespace asperity::lua
