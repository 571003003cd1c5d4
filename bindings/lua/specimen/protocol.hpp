// SPDX-License-Identifier: GPL-3.0-or-later
// lab.protocol, and protocols as native values of the language.
#pragma once

#include "bindings/lua/registry/registry.hpp"
#include "engine/specimen/protocol.hpp"

namespace asperity::lua {

template <>
const Class& class_of<Protocol>();

}  // namespace asperity::lua
