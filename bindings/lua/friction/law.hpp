// SPDX-License-Identifier: GPL-3.0-or-later
// lab.friction: the junction law as a native Lua value.
#pragma once

#include <optional>

#include "bindings/lua/registry/registry.hpp"
#include "engine/friction/junction_law.hpp"

namespace asperity::lua {

template <>
const Class& class_of<JunctionLaw>();

Function friction_function();

// `rest` of law:on and of the methods of a tilt stage.
struct OnKeys {
  std::optional<double> rest;
};
Option<OnKeys> rest_option();

}  // namespace asperity::lua
