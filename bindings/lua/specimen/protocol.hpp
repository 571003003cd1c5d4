// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "bindings/lua/registry/registry.hpp"
#include "engine/specimen/protocol.hpp"

namespace asperity::lua {

Class make_class(For<Protocol>);

// A press log, or a recording by detection of events.
Function protocol_read_function();

// A ProtocolEvent; k from 0.
Record event_of(const Protocol& protocol, std::size_t k);

// An event is a table with one key, a contact method, and its arguments as value. Throws one Error with all
// problems and event numbers. Nothing if a correct list contains placeholders.
std::optional<Protocol> read_protocol(const Argument& list, const std::string& caller);
const BlockInfo& protocol_keys();

}  // namespace asperity::lua
