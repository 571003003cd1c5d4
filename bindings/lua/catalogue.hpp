// SPDX-License-Identifier: GPL-3.0-or-later
// The modules and classes of the language, each defined in the file of its name.
#pragma once

#include "bindings/lua/registry.hpp"

namespace asperity::lua {

const Module& lab_module();
const Module& units_module();
const Module& surface_module();
const Module& profile_module();
const Module& protocol_module();
const Module& exact_module();
const Module& spread_module();

const Class& state_class();
const Class& state_error_class();
const Class& algebraic_error_class();
const Class& discretisation_error_class();
const Class& field_class();
const Class& plan_class();
const Class& ledger_class();
const Class& contact_class();
const Class& protocol_class();
const Class& law_class();
const Class& shear_class();
const Class& stylus_class();
const Class& stage_class();
const Class& notebook_class();
const Class& study_class();
const Class& study_choice_class();
const Class& material_class();
const Class& surface_class();
const Class& profile_class();
const Class& spread_surface_class();
const Class& spread_contact_class();
const Class& spread_state_class();

}  // namespace asperity::lua
