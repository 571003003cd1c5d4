// SPDX-License-Identifier: GPL-3.0-or-later
// s:registered_to(before): the method of surfaces, and the record that it gives.
#pragma once

#include <vector>

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "engine/metrology/registration.hpp"

namespace asperity::lua {

Function registered_to_method();
// The record and those within it.
std::vector<const RecordInfo*> registration_types();

}  // namespace asperity::lua
