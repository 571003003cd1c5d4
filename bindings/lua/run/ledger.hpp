// SPDX-License-Identifier: GPL-3.0-or-later
// lab.ledger: what was computed. Every call of the registry, every field read and every turn of an iterator
// is entered by the frames that make it.
#pragma once

#include "bindings/lua/registry/registry.hpp"
#include "engine/run/ledger.hpp"

namespace asperity::lua {

template <>
const Class& class_of<LedgerReport>();

Function ledger_function();

}  // namespace asperity::lua
