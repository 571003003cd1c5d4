// SPDX-License-Identifier: GPL-3.0-or-later
// Digest of the results of a heavy call, for the journal: native values by their digests; records, lists and
// tables by all numbers, booleans and texts. Costs are excluded, because equal calls take different times.
#pragma once

#include <string>

#include "bindings/lua/registry/value.hpp"

namespace asperity::lua {

std::string digest_of(const Object& object);
// "" for no value, or for texts only (paths of files).
std::string digest_of(const Values& results);

}  // namespace asperity::lua
