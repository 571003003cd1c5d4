// SPDX-License-Identifier: GPL-3.0-or-later
// Commands that tell and compute nothing: `asperity help`, of the language and of the program's own command
// line; `asperity materials`; `asperity version`.
#pragma once

#include <string>

#include "bindings/cli/commands/command.hpp"

namespace asperity::cli {

// `overview` is asked for the lines of all commands, which `asperity help` begins with.
Command help_command(std::string (*overview)());
Command materials_command();
Command version_command();

}  // namespace asperity::cli
