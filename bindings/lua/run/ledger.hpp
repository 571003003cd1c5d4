// SPDX-License-Identifier: GPL-3.0-or-later
// lab.ledger: the costs of all calls, field reads and turns of iterators. The calling frames enter the costs.
#pragma once

#include "bindings/lua/registry/registry.hpp"
#include "engine/run/ledger.hpp"

namespace asperity::lua {

template <>
const Class& class_of<LedgerReport>();

Function ledger_function();

}  // namespace asperity::lua
