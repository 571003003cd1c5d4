// SPDX-License-Identifier: GPL-3.0-or-later
// Help, reference page and LuaCATS types from the registry.
#pragma once

#include <string>
#include <vector>

#include "bindings/lua/registry/registry.hpp"

namespace asperity::lua {

// Topics: "lab", "lab.surface", "sine", "surface:scaled", "State.area" …; "" lists all. Throws
// Error{unknown_name} with the nearest topic.
std::string help_text(const std::string& topic);
// Full names for help_text().
std::vector<std::string> help_topics();

// "lab.surface.flat{ cells=, size= }"; "a length above 0, default \"1 um\""; "number, Pa".
std::string signature(const Function& function);
std::string describe_option(const OptionInfo& option);
std::string describe_field(const Getter& field);

// Values for the examples; each runs after it in its own run (tests/bindings/examples_test.cpp).
const std::string& example_preamble();
// docs/reference.md
std::string reference_page();
// docs/asperity.d.lua
std::string editor_types();

}  // namespace asperity::lua
