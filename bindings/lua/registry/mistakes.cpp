// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/mistakes.hpp"

#include <string_view>

#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/placeholder.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/core/monitor.hpp"

namespace asperity::lua {

namespace {
bool is_caught(lua_State* L) {
  lua_Debug frame;
  for (int level = 0; lua_getstack(L, level, &frame) != 0; ++level) {
    lua_getinfo(L, "Sn", &frame);
    const std::string_view name = frame.name == nullptr ? "" : frame.name;
    if (*frame.what == 'C' && (name == "pcall" || name == "xpcall")) return true;
  }
  return false;
}
}  // namespace

bool noted_as_mistake(lua_State* L) {
  Session* session = Session::find(L);
  if (session == nullptr || !session->dry_run || session->mistakes == nullptr) return false;
  if (stop_flag().reason() != StopReason::none) return false;
  const Argument error(L, -1);
  if (!error.is_text()) return false;
  const std::string message(error.text());
  // Errors in a script function called from C++ may be consequences of a placeholder.
  if (stopped_at_placeholder(message) || (session->gave_placeholders && met_nothing(message))) return false;
  if (is_caught(L)) {
    session->mistakes->note("a pcall catches this error: " + message);
    return false;
  }
  session->mistakes->add(message);
  session->gave_placeholders = true;
  lua_pop(L, 1);
  return true;
}

}  // namespace asperity::lua
