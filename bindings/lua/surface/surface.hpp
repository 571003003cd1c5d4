// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces and profiles as native values of the language.
#pragma once

#include "bindings/lua/registry/registry.hpp"
#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity::lua {

template <>
const Class& class_of<Surface>();
template <>
const Class& class_of<Profile>();

const Module& surface_module();
const Module& profile_module();

}  // namespace asperity::lua
