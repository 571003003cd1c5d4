// SPDX-License-Identifier: GPL-3.0-or-later
// The states of a contact as native Lua values.
#pragma once

#include <vector>

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/surface/field_class.hpp"
#include "engine/contact/certificate.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/state.hpp"
#include "engine/core/grid.hpp"

namespace asperity::lua {

// Fields common to all certificates; adhesive contacts add one.
std::vector<RecordField<Certificate>> certificate_fields();

template <>
const Class& class_of<asperity::State>();

// The result of contact:explain (plan.cpp).
template <>
const Class& class_of<Plan>();

}  // namespace asperity::lua
