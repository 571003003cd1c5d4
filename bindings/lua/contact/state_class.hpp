// SPDX-License-Identifier: GPL-3.0-or-later
// The states of a contact, and their fields over the tile, as native values of the language.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bindings/lua/registry/record_type.hpp"
#include "engine/contact/certificate.hpp"
#include "engine/contact/state.hpp"
#include "engine/core/grid.hpp"

namespace asperity::lua {

// A field of a state over the tile, with what it is.
struct StateField {
  std::string name;
  Grid grid;
  std::shared_ptr<const Field> values;
  Dimension dimension;
};

// Those of every certificate; bodies that attract each other have one more.
std::vector<RecordField<Certificate>> certificate_fields();

template <>
const Class& class_of<asperity::State>();
template <>
const Class& class_of<StateField>();

}  // namespace asperity::lua
