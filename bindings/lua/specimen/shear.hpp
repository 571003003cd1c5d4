// SPDX-License-Identifier: GPL-3.0-or-later
// contact:shear and its result: a contact under load that is pulled sideways by less than makes it slide.
#pragma once

#include "bindings/lua/registry/registry.hpp"
#include "engine/friction/partial_slip.hpp"

namespace asperity::lua {

template <>
const Class& class_of<PartialSlip>();

// The method of a contact.
Function shear_method();

}  // namespace asperity::lua
