// SPDX-License-Identifier: GPL-3.0-or-later
// lab.ledger and the plans that contact:explain gives: what is to be computed, and what was. Every call of
// the registry, every field read and every turn of an iterator is entered by the frames that make it.
#pragma once

#include <string_view>

#include "bindings/lua/registry.hpp"
#include "bindings/lua/session.hpp"
#include "engine/contact/plan.hpp"

namespace asperity::lua {

template <>
const Class& class_of<Plan>();
template <>
const Class& class_of<LedgerReport>();

Function ledger_function();

// A call that begins here. One that is not `lasting` gets a line only if it takes long enough to matter.
inline LedgerScope ledger_scope(const Session& session, std::string_view call, bool lasting,
                                std::string_view owner = {}) {
  return LedgerScope(*session.ledger, owner, call, session.is_case, lasting);
}
// What the states among the results of a call cost, by effect.
void enter_effects(const Session& session, const Values& results);

}  // namespace asperity::lua
