// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "bindings/lua/registry/registry.hpp"
#include "engine/friction/junction_law.hpp"

namespace asperity::lua {

Class make_class(For<JunctionLaw>);

Function friction_function();

// `rest` of law:on and tilt stages.
struct OnKeys {
  std::optional<double> rest;
};
Option<OnKeys> rest_option();

}  // namespace asperity::lua
