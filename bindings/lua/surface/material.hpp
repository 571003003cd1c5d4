// SPDX-License-Identifier: GPL-3.0-or-later
// lab.material, lab.materials and lab.rigid.
#pragma once

#include "bindings/lua/registry/registry.hpp"
#include "engine/surface/material.hpp"

namespace asperity::lua {

template <>
const Class& class_of<Material>();

Function material_function();
Value materials_list();
Value rigid_value();

}  // namespace asperity::lua
