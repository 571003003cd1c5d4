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

// protocol_reading.cpp: from a press log, or from a recording by detection of events.
Function protocol_read_function();

// The events of lab.protocol (protocol_events.cpp). An event is a table with one key, a contact method, and
// its arguments as value. Throws one Error with all problems and event numbers. Nothing if a correct list
// contains placeholders.
std::optional<Protocol> read_protocol(const Argument& list, const std::string& caller);
const BlockInfo& protocol_keys();

}  // namespace asperity::lua
