// SPDX-License-Identifier: GPL-3.0-or-later
// What the registry says about itself, for people: help on a topic, the reference page, and the
// types an editor reads (LuaCATS). All three come from the entries that also drive the calls, so
// they cannot disagree with what the program does.
#pragma once

#include <string>
#include <vector>

#include "bindings/lua/registry/registry.hpp"

namespace asperity::lua {

// Help on "lab", "lab.surface", "sine", "surface:scaled", "State.area" …; "" lists the topics.
// Throws Error{unknown_name} with the nearest topic.
std::string help_text(const std::string& topic);
// Everything that help_text() knows by its full name.
std::vector<std::string> help_topics();

// One line each: "lab.surface.flat{ cells=, size= }"; "a length above 0, default \"1 um\""; "number, Pa".
std::string signature(const Function& function);
std::string describe_option(const OptionInfo& option);
std::string describe_field(const Getter& field);

// What stands before each example of the registry: the values that examples use by name. Every example runs
// after it, in a run of its own (tests/bindings/examples_test.cpp).
const std::string& example_preamble();
// docs/reference.md
std::string reference_page();
// docs/asperity.d.lua
std::string editor_types();

}  // namespace asperity::lua
