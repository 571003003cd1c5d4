// SPDX-License-Identifier: GPL-3.0-or-later
// What contact:explain gives: the plan of a press, what is to be computed and what it is expected to cost.
#pragma once

#include "bindings/lua/registry/registry.hpp"
#include "engine/contact/plan.hpp"

namespace asperity::lua {

template <>
const Class& class_of<Plan>();

}  // namespace asperity::lua
