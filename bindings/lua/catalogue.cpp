// SPDX-License-Identifier: GPL-3.0-or-later
// The list of everything a script can see, one line a module and a class.
#include "bindings/lua/catalogue.hpp"

#include "bindings/lua/registry.hpp"

namespace asperity::lua {

const std::vector<const Module*>& modules() {
  static const std::vector<const Module*> all = {
      &lab_module(),      &units_module(), &surface_module(), &profile_module(),
      &protocol_module(), &exact_module(), &spread_module(),
  };
  return all;
}

const std::vector<const Class*>& classes() {
  static const std::vector<const Class*> all = {
      &material_class(),       &surface_class(),      &profile_class(),         &contact_class(),
      &state_class(),          &state_error_class(),  &algebraic_error_class(), &discretisation_error_class(),
      &field_class(),          &plan_class(),         &ledger_class(),          &stylus_class(),
      &protocol_class(),       &law_class(),          &shear_class(),           &stage_class(),
      &notebook_class(),       &study_class(),        &study_choice_class(),    &spread_surface_class(),
      &spread_contact_class(), &spread_state_class(),
  };
  return all;
}

const Class* find_class(std::string_view name) {
  for (const Class* type : classes())
    if (type->name == name) return type;
  return nullptr;
}

}  // namespace asperity::lua
