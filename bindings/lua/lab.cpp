// SPDX-License-Identifier: GPL-3.0-or-later
// The module lab: help, quantities as numbers, unit factors of lab.units.
#include <numbers>
#include <string>

#include "bindings/lua/editor/help.hpp"
#include "bindings/lua/ensemble/ensemble.hpp"
#include "bindings/lua/friction/law.hpp"
#include "bindings/lua/metrology/stylus.hpp"
#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/run/ledger.hpp"
#include "bindings/lua/run/notebook.hpp"
#include "bindings/lua/runtime/base_library.hpp"
#include "bindings/lua/runtime/version.hpp"
#include "bindings/lua/specimen/contact.hpp"
#include "bindings/lua/specimen/tilt_stage.hpp"
#include "bindings/lua/study/study.hpp"
#include "bindings/lua/surface/grid_keys.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

Function files_function();

namespace {

// Help on a Lua value: a function of the laboratory, a module, an object, a result.
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
  throw Error(ErrorCode::bad_value, "`topic` is " + value.describe(),
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
    throw Error(ErrorCode::bad_value, "`kind` is \"" + plain_text(text) + "\"" + did_you_mean(text, names),
                "give the name of a kind, such as \"length\" or \"pressure\", or a unit of it");
  }
}

Values quantity_value(Call& call) {
  if (call.argument(1).is_number()) return {call.argument(1).number()};
  const std::string text = call.text(1, "quantity");
  if (!call.given(2)) return {parse_quantity(text).value};
  return {parse_quantity_as(text, kind_given(call.text(2, "kind")))};
}

Function quantity_function() {
  return {
      .name = "quantity",
      .body = quantity_value,
      .sentence =
          "A quantity as a number in SI, as every key of the language takes it: lab.quantity \"250 um\" is "
          "2.5e-4. A plain number stays as it is.",
      .parameters = {{"quantity", "string|number", "a number with a unit"},
                     {"kind", "string?", "what it has to be: \"length\", \"pressure\", …, or a unit of it"}},
      .returns = "number",
      .example = "print(lab.quantity(\"640 HV\", \"pressure\"))"};
}

template <int numerator, int denominator = 1>
Value factor() {
  return static_cast<double>(numerator) / denominator;
}

}  // namespace

const Module& lab_module() {
  static const Module module = [] {
    Module m;
    m.path = "lab";
    m.sentence = "The laboratory: surfaces, contacts, friction, and the notebook that keeps what was found.";
    m.functions = {material_function(), stylus_function(),     contact_function(),
                   friction_function(), tilt_stage_function(), notebook_function()};
    m.functions.push_back(ensemble_function());
    m.functions.push_back(work_precision_function());
    m.functions.push_back(calibrate_function());
    m.functions.push_back(budget_function());
    m.functions.push_back(sensitivity_function());
    m.functions.push_back(ledger_function());
    m.functions.push_back(files_function());
    m.functions.push_back(quantity_function());
    m.functions.push_back(
        {.name = "help",
         .body = help,
         .sentence = "What the laboratory can do, or one function, value or field of it, as text.",
         .parameters = {{"topic", "any?",
                         "what to explain: a name or part of one, a key, or the function or value itself; "
                         "nothing lists the topics"}},
         .returns = "string",
         .example = "print(lab.help \"surface.sine\")"});
    m.constants = {
        {"rigid", "Material", "a body that does not deform", rigid_value},
        {"materials", "Material[]", "the materials known by name, a list; lab.materials.steel is one of them",
         materials_list},
        {"sorted", "function",
         "lab.sorted(t) goes through a table in the order of its keys, for a for loop, as `pairs` does in a "
         "script (numbers, strings by their bytes, booleans); other keys than numbers and strings are "
         "refused",
         [] { return Value(Script{"sorted"}); }},
        {"version", "string", "the version of the program", [] { return Value(version_text()); }}};
    return m;
  }();
  return module;
}

const Module& units_module() {
  static const Module module = {
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
  return module;
}

}  // namespace asperity::lua
