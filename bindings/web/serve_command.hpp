// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "bindings/cli/commands/command.hpp"

namespace asperity::web {

// Its work returns 0 after Ctrl-C.
cli::Command serve_command();

}  // namespace asperity::web
