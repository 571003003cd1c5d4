// SPDX-License-Identifier: GPL-3.0-or-later
// lab.protocol, and protocols as native values of the language.
#pragma once

#include <optional>
#include <string>

#include "bindings/lua/registry/registry.hpp"
#include "engine/specimen/protocol.hpp"

namespace asperity::lua {

template <>
const Class& class_of<Protocol>();

// lab.protocol.read (protocol_reading.cpp): from a press log, row by row, or from a recording, whose events
// are detected.
Function protocol_read_function();

// The list of events that lab.protocol takes (protocol_events.cpp): one table an event, with one key that
// says what is done and, under it, what the contact's method of that name takes. Throws Error with every
// problem of the list, each by the number of its event. Nothing if the list is right as far as it is known
// but holds placeholders of a dry run.
std::optional<Protocol> read_protocol(const Argument& list, const std::string& caller);
// The keys, for the registry.
const BlockInfo& protocol_keys();

}  // namespace asperity::lua
