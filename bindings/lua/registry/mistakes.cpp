// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/mistakes.hpp"

#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/placeholder.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/core/monitor.hpp"

namespace asperity::lua {

bool noted_as_mistake(lua_State* L) {
  Session* session = Session::find(L);
  if (session == nullptr || !session->dry_run || session->mistakes == nullptr) return false;
  if (stop_flag().reason() != StopReason::none) return false;
  const Argument error(L, -1);
  if (!error.is_text()) return false;
  const std::string message(error.text());
  // What a function of the script met inside a call is its own affair.
  if (stopped_at_placeholder(message) || (session->gave_placeholders && met_nothing(message))) return false;
  session->mistakes->add(message);
  session->gave_placeholders = true;
  lua_pop(L, 1);
  return true;
}

}  // namespace asperity::lua
