// SPDX-License-Identifier: GPL-3.0-or-later
// lab.friction: the junction law.
#pragma once

#include <optional>

#include "bindings/lua/registry/registry.hpp"
#include "engine/friction/junction_law.hpp"

namespace asperity::lua {

template <>
const Class& class_of<JunctionLaw>();

Function friction_function();

// `rest` of law:on and tilt stages.
struct OnKeys {
  std::optional<double> rest;
};
Option<OnKeys> rest_option();

}  // namespace asperity::lua
