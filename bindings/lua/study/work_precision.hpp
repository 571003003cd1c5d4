// SPDX-License-Identifier: GPL-3.0-or-later
// lab.work_precision: what a quantity costs to a given accuracy, by several ways over their settings.
#pragma once

#include "bindings/lua/registry/registry.hpp"

namespace asperity::lua {

Function work_precision_function();

}  // namespace asperity::lua
