// SPDX-License-Identifier: GPL-3.0-or-later
// The filter of system calls, which libseccomp makes: a list of what a computation needs, and everything else
// refused. It comes as the part asperity-sandbox.so (bindings/web/seccomp).
#pragma once

#include <string>

#include "bindings/web/sandbox/confinement.hpp"

namespace asperity::web {

// Returns why it could not be put up, or "". The part must have been loaded before files were shut off:
// load_system_call_filter() does, and returns why it could not.
std::string load_system_call_filter();
std::string confine_system_calls(Confined as);

// The part's symbol `asperity_confine_system_calls`: why it could not, or null.
using ConfineSystemCalls = const char*(Confined as);

}  // namespace asperity::web
