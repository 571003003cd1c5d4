// SPDX-License-Identifier: GPL-3.0-or-later
// lab.sensitivity: which uncertain input an answer hangs on, and which to measure better next.
#pragma once

#include "bindings/lua/registry/registry.hpp"
#include "engine/study/sensitivity.hpp"

namespace asperity::lua {

Function sensitivity_function();

template <>
const Class& class_of<Sensitivity>();

}  // namespace asperity::lua
