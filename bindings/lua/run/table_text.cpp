// SPDX-License-Identifier: GPL-3.0-or-later
// Printing with units: t:show and lab.say.
#include <algorithm>

#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/run/run.hpp"
#include "bindings/lua/run/table_values.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "engine/core/monitor.hpp"
#include "engine/core/require.hpp"
#include "engine/statistics/table_operations.hpp"

namespace asperity::lua {

namespace {

// Calls a Lua function of a global table, or a global one for an empty `library`; its result is on the stack.
void call_lua(lua_State* L, const char* library, const char* name, const std::vector<Value>& arguments,
              int results) {
  auto push_all = [&](lua_State* s) {
    if (*library == '\0') {
      lua_getglobal(s, name);
    } else {
      lua_getglobal(s, library);
      lua_getfield(s, -1, name);
      lua_remove(s, -2);
    }
    for (const Value& argument : arguments) push(s, argument);
    return 1 + static_cast<int>(arguments.size());
  };
  const int count = static_cast<int>(arguments.size());
  if (protect(L, 0, 1 + count, push_all) != LUA_OK || lua_pcall(L, count, results, 0) != LUA_OK) {
    stop_flag().check();
    refuse(error_text(L, -1));
  }
}

void print_text(lua_State* L, const std::string& text) {
  const Argument::StackGuard guard(L);
  call_lua(L, "", "print", {Value(text)}, 0);
}

struct ShownColumns {
  std::vector<std::string> names;
  int digits = 6;
};

// { "Ra [um]", "angle [deg]", digits=3 }
ShownColumns shown_columns(const Argument& given) {
  ShownColumns shown;
  const auto refuse_entry = [&](const Argument& key, const Argument& value) {
    refuse("t:show met " + key.describe() + " = " + value.describe(),
           "write t:show{ \"Ra [um]\", \"angle [deg]\", digits=3 }");
  };
  if (!given.is_table()) return shown;
  given.elements([&](const Argument& name) {
    if (!name.is_text()) refuse_entry(name, name);
    shown.names.emplace_back(name.text());
  });
  given.each([&](const Argument& key, const Argument& value) {
    if (!key.is_text()) return;
    const std::int64_t digits = value.is_number() ? value.integer().value_or(0) : 0;
    if (key.text() != "digits" || digits < 1 || digits > 17) refuse_entry(key, value);
    shown.digits = static_cast<int>(digits);
  });
  return shown;
}

// A directive of string.format ("%5.2f") and its unit in brackets.
struct Directive {
  std::size_t end = 0;                       // of the directive
  std::size_t unit_begin = 0, unit_end = 0;  // `end` without a unit
  std::string unit{};
};

std::vector<Directive> directives_in(const std::string& format) {
  std::vector<Directive> found;
  for (std::size_t k = 0; (k = format.find('%', k)) != std::string::npos;) {
    if (k + 1 < format.size() && format[k + 1] == '%') {
      k += 2;
      continue;
    }
    Directive one{std::min(format.find_first_not_of("-+ #0123456789.", k + 1), format.size() - 1) + 1};
    one.unit_begin = one.unit_end = one.end;
    const std::size_t open = format.find_first_not_of(' ', one.end);
    if (open != std::string::npos && format[open] == '[')
      if (const std::size_t close = format.find(']', open); close != std::string::npos) {
        one.unit = format.substr(open + 1, close - open - 1);
        one.unit_begin = open;
        one.unit_end = close + 1;
      }
    found.push_back(one);
    k = one.unit_end;  // past the % of "[%]"
  }
  return found;
}

Values say(Call& call) {
  const std::string given = call.text(1, "format");
  const std::vector<Directive> directives = directives_in(given);
  std::string format;
  std::vector<Value> arguments = {Value()};
  std::size_t done = 0;
  for (std::size_t k = 0; k < directives.size(); ++k) {
    const Directive& one = directives[k];
    const Argument value = call.argument(static_cast<int>(k) + 2);
    const bool converts = !one.unit.empty() && value.is_number();
    if (converts) parse_unit(one.unit);
    if (value.is_unknown()) return {};
    if (converts)
      arguments.emplace_back(in_unit(value.number(), one.unit));
    else if (value.is_number() && value.integer())
      arguments.emplace_back(*value.integer());
    else if (value.is_number())
      arguments.emplace_back(value.number());
    else if (value.is_text())
      arguments.emplace_back(std::string(value.text()));
    else if (value.is_boolean())
      arguments.emplace_back(value.boolean() ? "true" : "false");
    else
      refuse("argument " + std::to_string(k + 2) + " of lab.say is " + value.describe(),
             "give a number, a string or a boolean for each directive; %% prints a percent sign");
    format += given.substr(done, one.end - done);
    done = one.end;
    if (converts) {
      const bool percent = one.unit == "%";
      format += given.substr(one.end, one.unit_begin - one.end) + (percent ? "%%" : one.unit);
      done = one.unit_end;
    }
  }
  arguments.front() = Value(format + given.substr(done));
  const Argument::StackGuard guard(call.L);
  call_lua(call.L, "string", "format", arguments, 1);
  print_text(call.L, std::string(Argument(call.L, -1).text()));
  return {};
}

}  // namespace

Function show_method() {
  return {.name = "show",
          .body = [](Call& call) -> Values {
            const ShownColumns shown = shown_columns(call.argument(1));
            const auto table = table_of_self(call);
            print_text(call.L, table_text(columns_of(*table, shown.names), table->rows(), shown.digits));
            return {};
          },
          .sentence = "Prints all rows; with names, only these columns, in the units of the names.",
          .parameters = {{"columns", "table?", "names of columns, and digits=6 for the significant digits"}},
          .example = "book:show{ \"N\", \"mu [%]\", digits=3 }",
          .unknown_when_dry = true};
}

Function say_function() {
  return {.name = "say",
          .body = say,
          .sentence =
              "Prints like string.format. A unit in brackets behind a directive converts the number "
              "from SI and is printed without brackets.",
          .parameters = {{"format", "string", "text with directives, such as \"Ra %.2f [um]\""},
                         {"...", "any", "a value for each directive"}},
          .example = "lab.say(\"Ra %.2f [um], slips at %.1f [deg]\", 2.8e-6, 0.4)"};
}

}  // namespace asperity::lua
