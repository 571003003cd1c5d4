// SPDX-License-Identifier: GPL-3.0-or-later
// lab.ensemble: a function for every case of a study, on threads.
#pragma once

#include "bindings/lua/registry/registry.hpp"

namespace asperity::lua {

Function ensemble_function();

}  // namespace asperity::lua
