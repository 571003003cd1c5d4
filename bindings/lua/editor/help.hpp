// SPDX-License-Identifier: GPL-3.0-or-later
// Help texts, the reference page and the LuaCATS types for editors. All come from the registry entries that
// also drive the calls, and therefore agree with the program.
#pragma once

#include <string>
#include <vector>

#include "bindings/lua/registry/registry.hpp"

namespace asperity::lua {

// Help on "lab", "lab.surface", "sine", "surface:scaled", "State.area" …; "" lists the topics. Throws
// Error{unknown_name} with the nearest topic.
std::string help_text(const std::string& topic);
// All full names that help_text() accepts.
std::vector<std::string> help_topics();

// One line each: "lab.surface.flat{ cells=, size= }"; "a length above 0, default \"1 um\""; "number, Pa".
std::string signature(const Function& function);
std::string describe_option(const OptionInfo& option);
std::string describe_field(const Getter& field);

// Defines the values that the examples of the registry use. Each example runs after this preamble in its own
// run (tests/bindings/examples_test.cpp).
const std::string& example_preamble();
// docs/reference.md
std::string reference_page();
// docs/asperity.d.lua
std::string editor_types();

}  // namespace asperity::lua
