// SPDX-License-Identifier: GPL-3.0-or-later
// lab.budget: the whole error of a number, and what each part of it costs.
#pragma once

#include "bindings/lua/registry/registry.hpp"
#include "engine/study/budget.hpp"

namespace asperity::lua {

Function budget_function();

template <>
const Class& class_of<Budget>();

}  // namespace asperity::lua
