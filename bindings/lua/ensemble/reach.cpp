// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/ensemble/reach.hpp"

#include <algorithm>
#include <cctype>

#include "engine/core/text.hpp"

namespace asperity::lua {

bool is_name(std::string_view text) {
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
         std::all_of(text.begin(), text.end(),
                     [](char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; });
}

std::string step_text(const Argument& key) {
  if (key.is_text())
    return is_name(key.text()) ? "." + std::string(key.text())
                               : "[\"" + std::string(key.text().substr(0, 40)) + "\"]";
  if (key.is_number())
    return "[" + (key.integer() ? std::to_string(*key.integer()) : format_short(key.number())) + "]";
  return "[" + key.describe() + "]";
}

std::string kind_of_userdata(const Argument& value) {
  lua_State* L = value.state();
  const Argument::StackGuard guard(L);
  std::string name;
  if (lua_getmetatable(L, value.index()) != 0)
    with_key(Argument(L, -1), "__name", [&](const Argument& text) { name = text.text(); });
  if (name.empty()) return "state that cannot be copied";
  if (name == LUA_FILEHANDLE) return "an open file";
  const bool vowel = std::string_view("aeiou").find(name[0]) != std::string_view::npos;
  return (vowel ? "an " : "a ") + name;
}

}  // namespace asperity::lua
