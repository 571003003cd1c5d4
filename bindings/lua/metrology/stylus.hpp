// SPDX-License-Identifier: GPL-3.0-or-later
// lab.stylus.
#pragma once

#include "bindings/lua/registry/registry.hpp"
#include "engine/metrology/stylus.hpp"

namespace asperity::lua {

Class make_class(For<Stylus>);

Function stylus_function();

}  // namespace asperity::lua
