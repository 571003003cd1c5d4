// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/runtime/quantity_value.hpp"

#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

namespace {

// A kind by its name, "pressure", or that of a unit, "MPa".
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

}  // namespace

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

}  // namespace asperity::lua
