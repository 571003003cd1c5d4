// SPDX-License-Identifier: GPL-3.0-or-later
// How a script reaches a value, in the words of an error: `app.bench[2]`, an open file.
#pragma once

#include <string>
#include <string_view>

#include "bindings/lua/registry/argument.hpp"

namespace asperity::lua {

// Whether a text can be written after a dot.
bool is_name(std::string_view text);
// ".bench", "[3]", "[\"two words\"]".
std::string step_text(const Argument& key);
// "an open file", "an iterator": a userdata that is no value of ours, by the name of its kind.
std::string kind_of_userdata(const Argument& value);

}  // namespace asperity::lua
