// SPDX-License-Identifier: GPL-3.0-or-later
// Fields over grid nodes as native values: results of a state, masks of measured points.
#pragma once

#include <memory>
#include <string>

#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/value.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/quantity.hpp"
#include "engine/plot/picture.hpp"

namespace asperity::lua {

struct NamedField {
  std::string name;
  Grid grid;
  std::shared_ptr<const Field> values;
  Dimension dimension;
};

template <>
const Class& class_of<NamedField>();

// Picture options of surfaces and fields.
const Block<PictureOptions>& picture_block();

}  // namespace asperity::lua
