// SPDX-License-Identifier: GPL-3.0-or-later
// What the registry says about itself, for people: help on a topic, the reference page, and the
// types an editor reads (LuaCATS). All three come from the entries that also drive the calls, so
// they cannot disagree with what the program does.
#pragma once

#include <string>

namespace asperity::lua {

// Help on "lab", "lab.surface", "sine", "surface:scaled", "State.area" …; "" lists the topics.
// Throws Error{unknown_name} with the nearest topic.
std::string help_text(const std::string& topic);
// docs/reference.md
std::string reference_page();
// docs/asperity.d.lua
std::string editor_types();

}  // namespace asperity::lua
