// SPDX-License-Identifier: GPL-3.0-or-later
// The module lab: help, quantities, unit factors.
#include <array>
#include <numbers>
#include <string>

#include "bindings/lua/contact/state_class.hpp"
#include "bindings/lua/editor/help.hpp"
#include "bindings/lua/ensemble/scripted_cases.hpp"
#include "bindings/lua/friction/law.hpp"
#include "bindings/lua/metrology/stylus.hpp"
#include "bindings/lua/registry/library.hpp"
#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/run/run.hpp"
#include "bindings/lua/runtime/base_library.hpp"
#include "bindings/lua/runtime/version.hpp"
#include "bindings/lua/specimen/contact.hpp"
#include "bindings/lua/specimen/protocol.hpp"
#include "bindings/lua/specimen/tilt_stage.hpp"
#include "bindings/lua/spread/spread.hpp"
#include "bindings/lua/study/study.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/core/require.hpp"

namespace asperity::lua {

Function files_function();
Module protocol_module();
Module exact_module();
Module spread_module();

namespace {

// A function, a module, an object, a result.
std::string help_on(const Argument& value) {
  lua_State* L = value.state();
  const Argument::StackGuard guard(L);
  if (const Module* module = module_at(L, value.index())) return help_text(module->path);
  if (const Object* object = value.as_any_object()) return help_text(object->type->name);
  if (const std::shared_ptr<Record> record = record_at(L, value.index())) {
    std::string text = "A " + record->name + " result, with its values:\n";
    for (const Record::Entry& entry : record->entries)
      if (!entry.value.is_nil()) text += "  " + entry.field + "  " + show(entry) + "\n";
    return text +
           (record->type == nullptr ? "" : "help \"" + record->type->name + "\" says what they are.\n");
  }
  if (lua_iscfunction(L, value.index())) {
    if (lua_getupvalue(L, value.index(), 1) != nullptr)
      if (const std::string* name = name_of_entry(lua_touserdata(L, -1))) return help_text(*name);
    if (const BasePath* path = base_function(lua_tocfunction(L, value.index())))
      return (path->library == "_G" ? path->key : path->library + "." + path->key) +
             ": a function of Lua itself, which its manual explains (https://www.lua.org/manual/5.4)\n";
  }
  if (value.is_function()) {
    lua_Debug facts;
    lua_pushvalue(L, value.index());
    lua_getinfo(L, ">S", &facts);
    if (is_sandbox_function(L, value.index())) return "a function of Lua itself\n";
    return std::string("a function of this script, line ") + std::to_string(facts.linedefined) + "\n";
  }
  refuse("`topic` is " + value.describe(),
         "give a name such as \"surface.sine\", or a value of the laboratory");
}

Values help(Call& call) {
  if (!call.given(1)) return {help_text("")};
  return {call.argument(1).is_text() ? help_text(call.text(1, "topic")) : help_on(call.argument(1))};
}

// The kind by its name ("pressure") or by a unit ("MPa").
Dimension kind_given(const std::string& text) {
  if (const auto kind = dimension_named(text)) return *kind;
  try {
    return parse_unit(text).dimension;
  } catch (const Error&) {
    const std::vector<std::string> names = dimension_names();
    refuse("`kind` is \"" + plain_text(text) + "\"" + did_you_mean(text, names),
           "give the name of a kind, such as \"length\" or \"pressure\", or a unit of it");
  }
}

Function quantity_function() {
  return {
      .name = "quantity",
      .body = [](Call& call) -> Values {
        if (call.argument(1).is_number()) return {call.argument(1).number()};
        const std::string text = call.text(1, "quantity");
        if (!call.given(2)) return {parse_quantity(text).value};
        return {parse_quantity_as(text, kind_given(call.text(2, "kind")))};
      },
      .sentence =
          "A quantity as a number in SI, as every key of the language takes it: lab.quantity \"250 um\" is "
          "2.5e-4. A plain number stays as it is.",
      .parameters = {{"quantity", "string|number", "a number with a unit"},
                     {"kind", "string?", "what it has to be: \"length\", \"pressure\", …, or a unit of it"}},
      .returns = "number",
      .example = "print(lab.quantity(\"640 HV\", \"pressure\"))"};
}

template <class... T>
std::vector<const Class*> classes_of() {
  return {&class_of<T>()...};
}

template <int numerator, int denominator = 1>
Value factor() {
  return static_cast<double>(numerator) / denominator;
}

}  // namespace

Module lab_module() {
  Module m{"lab", "The laboratory: surfaces, contacts, friction, and the notebook for results."};
  m.functions = {material_function(),
                 stylus_function(),
                 contact_function(),
                 friction_function(),
                 tilt_stage_function(),
                 notebook_function(),
                 ensemble_function(),
                 work_precision_function(),
                 calibrate_function(),
                 budget_function(),
                 sensitivity_function(),
                 ledger_function(),
                 say_function(),
                 files_function(),
                 quantity_function(),
                 {.name = "help",
                  .body = help,
                  .sentence = "Help as text: on the laboratory, or on one function, value or field.",
                  .parameters = {{"topic", "any?",
                                  "the topic: a name or part of a name, a key, or the function or value "
                                  "itself; without it the topics are listed"}},
                  .returns = "string",
                  .example = "print(lab.help \"surface.sine\")"}};
  m.constants = {
      {"rigid", "Material", "a body that does not deform", [] { return object(rigid_material()); }},
      {"materials", "Material[]", "the materials known by name, a list; for example lab.materials.steel",
       [] { return detail::value_of_held(named_materials()); }},
      {"sorted", "function",
       "lab.sorted(t) goes through a table in the order of its keys, for a for loop, as `pairs` does in a "
       "script (numbers, strings by their bytes, booleans); other keys than numbers and strings are refused",
       [] { return Value(Script{"sorted"}); }},
      {"version", "string", "the version of the program", [] { return Value(version_text()); }}};
  return m;
}

Module units_module() {
  return {
      .path = "lab.units",
      .sentence = "SI values of units, for printing: st.approach / lab.units.um is in micrometres.",
      .constants = {{"m", "number", "metre", factor<1>},
                    {"mm", "number", "millimetre", factor<1, 1000>},
                    {"um", "number", "micrometre", factor<1, 1000000>},
                    {"nm", "number", "nanometre", factor<1, 1000000000>},
                    {"kg", "number", "kilogram", factor<1>},
                    {"g", "number", "gram", factor<1, 1000>},
                    {"s", "number", "second", factor<1>},
                    {"min", "number", "minute", factor<60>},
                    {"h", "number", "hour", factor<3600>},
                    {"N", "number", "newton", factor<1>},
                    {"mN", "number", "millinewton", factor<1, 1000>},
                    {"Pa", "number", "pascal", factor<1>},
                    {"kPa", "number", "kilopascal", factor<1000>},
                    {"MPa", "number", "megapascal", factor<1000000>},
                    {"GPa", "number", "gigapascal", factor<1000000000>},
                    {"rad", "number", "radian", factor<1>},
                    {"deg", "number", "degree", [] { return Value(std::numbers::pi / 180.0); }}},
  };
}

const std::vector<const Module*>& modules() {
  static const std::array<Module, 9> made{lab_module(),     units_module(),    surface_module(),
                                          profile_module(), protocol_module(), exact_module(),
                                          spread_module(),  table_module(),    knob_module()};
  static const std::vector<const Module*> all = [] {
    std::vector<const Module*> listed;
    for (const Module& module : made) listed.push_back(&module);
    return listed;
  }();
  return all;
}
const std::vector<const Class*>& classes() {
  static const std::vector<const Class*> all =
      classes_of<Material, Surface, Profile, ArealParameters, MaterialRatioCurve, Autocorrelation,
                 SpecimenPair, asperity::State, StateError, StateBounds, DiscretisationError, NamedField,
                 Plan, LedgerReport, Stylus, Protocol, JunctionLaw, PartialSlip, TiltStage, Notebook,
                 asperity::Table, Budget, Sensitivity, Study, StudyChoice, CalibrationReport, SlabSurface,
                 SpreadContact, SpreadState>();
  return all;
}

}  // namespace asperity::lua
