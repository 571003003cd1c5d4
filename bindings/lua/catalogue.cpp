// SPDX-License-Identifier: GPL-3.0-or-later
// All modules and classes of the language, one per line.
#include "bindings/lua/contact/discretisation_error.hpp"
#include "bindings/lua/contact/state_class.hpp"
#include "bindings/lua/contact/state_error.hpp"
#include "bindings/lua/friction/law.hpp"
#include "bindings/lua/metrology/stylus.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/run/knob.hpp"
#include "bindings/lua/run/ledger.hpp"
#include "bindings/lua/run/notebook.hpp"
#include "bindings/lua/run/table.hpp"
#include "bindings/lua/specimen/contact.hpp"
#include "bindings/lua/specimen/protocol.hpp"
#include "bindings/lua/specimen/tilt_stage.hpp"
#include "bindings/lua/spread/spread.hpp"
#include "bindings/lua/study/study.hpp"
#include "bindings/lua/surface/grid_keys.hpp"
#include "bindings/lua/surface/surface.hpp"

namespace asperity::lua {

const Module& lab_module();
const Module& units_module();
const Module& protocol_module();
const Module& exact_module();
const Module& spread_module();

const std::vector<const Module*>& modules() {
  static const std::vector<const Module*> all = {
      &lab_module(),   &units_module(),  &surface_module(), &profile_module(), &protocol_module(),
      &exact_module(), &spread_module(), &table_module(),   &knob_module(),
  };
  return all;
}

const std::vector<const Class*>& classes() {
  static const std::vector<const Class*> all = {
      &class_of<Material>(),
      &class_of<Surface>(),
      &class_of<Profile>(),
      &class_of<ArealParameters>(),
      &class_of<MaterialRatioCurve>(),
      &class_of<Autocorrelation>(),
      &class_of<SpecimenPair>(),
      &class_of<asperity::State>(),
      &class_of<StateError>(),
      &class_of<StateBounds>(),
      &class_of<DiscretisationError>(),
      &class_of<NamedField>(),
      &class_of<Plan>(),
      &class_of<LedgerReport>(),
      &class_of<Stylus>(),
      &class_of<Protocol>(),
      &class_of<JunctionLaw>(),
      &class_of<PartialSlip>(),
      &class_of<TiltStage>(),
      &class_of<Notebook>(),
      &class_of<asperity::Table>(),
      &class_of<Budget>(),
      &class_of<Sensitivity>(),
      &class_of<Study>(),
      &class_of<StudyChoice>(),
      &class_of<CalibrationReport>(),
      &class_of<SlabSurface>(),
      &class_of<SpreadContact>(),
      &class_of<SpreadState>(),
  };
  return all;
}

const Class* find_class(std::string_view name) {
  for (const Class* type : classes())
    if (type->name == name) return type;
  return nullptr;
}

}  // namespace asperity::lua
