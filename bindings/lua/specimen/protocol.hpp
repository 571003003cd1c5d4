// SPDX-License-Identifier: GPL-3.0-or-later
// lab.protocol, and protocols as native values.
#pragma once

#include <optional>
#include <string>

#include "bindings/lua/registry/registry.hpp"
#include "engine/specimen/protocol.hpp"

namespace asperity::lua {

template <>
const Class& class_of<Protocol>();

// lab.protocol.read (protocol_reading.cpp): from a press log, row by row, or from a recording, by detection
// of events.
Function protocol_read_function();

// Reads the list of events of lab.protocol (protocol_events.cpp). An event is a table with one key, the name
// of a contact method, and the arguments of the method as value. Throws one Error with all problems and their
// event numbers. Returns nothing if a correct list contains placeholders.
std::optional<Protocol> read_protocol(const Argument& list, const std::string& caller);
const BlockInfo& protocol_keys();

}  // namespace asperity::lua
