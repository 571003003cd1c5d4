// SPDX-License-Identifier: GPL-3.0-or-later
// lab.protocol.read: a protocol from a press log, row by row, or from a recording, whose events are detected.
#pragma once

#include "bindings/lua/registry/registry.hpp"

namespace asperity::lua {

Function protocol_read_function();

}  // namespace asperity::lua
