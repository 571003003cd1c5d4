// SPDX-License-Identifier: GPL-3.0-or-later
// The digest of what a heavy call returned, for the journal: native values by their own digests, records,
// lists and tables by all the numbers, truths and texts in them. Costs are left out, for equal calls take
// different times.
#pragma once

#include <string>

#include "bindings/lua/registry/value.hpp"

namespace asperity::lua {

// That of a native value; "" where it has none.
std::string digest_of(const Object& object);
// "" where there is nothing that could be compared: no value, or texts alone (the place of a file).
std::string digest_of(const Values& results);

}  // namespace asperity::lua
