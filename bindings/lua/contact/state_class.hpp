// SPDX-License-Identifier: GPL-3.0-or-later
// The states of a contact as native values of the language.
#pragma once

#include <vector>

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/surface/field_class.hpp"
#include "engine/contact/certificate.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/state.hpp"
#include "engine/core/grid.hpp"

namespace asperity::lua {

// Those of every certificate; bodies that attract each other have one more.
std::vector<RecordField<Certificate>> certificate_fields();

template <>
const Class& class_of<asperity::State>();

// What contact:explain gives (plan.cpp): the plan of a press, what is to be computed and what it is expected
// to cost.
template <>
const Class& class_of<Plan>();

}  // namespace asperity::lua
