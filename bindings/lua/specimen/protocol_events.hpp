// SPDX-License-Identifier: GPL-3.0-or-later
// The list of events that lab.protocol takes: one table an event, with one key that says what is done and,
// under it, what the contact's method of that name takes.
#pragma once

#include <optional>
#include <string>

#include "bindings/lua/registry/registry.hpp"
#include "engine/specimen/protocol.hpp"

namespace asperity::lua {

// Throws Error with every problem of the list, each by the number of its event. Nothing if the list is right
// as far as it is known but holds placeholders of a dry run.
std::optional<Protocol> read_protocol(const Argument& list, const std::string& caller);
// The keys, for the registry.
const BlockInfo& protocol_keys();

}  // namespace asperity::lua
