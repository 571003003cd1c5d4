// SPDX-License-Identifier: GPL-3.0-or-later
// The system call filter of libseccomp: an allow list for computations. The filter is the part
// asperity-sandbox.so (bindings/web/seccomp).
#pragma once

#include <string>

#include "bindings/web/sandbox/confinement.hpp"

namespace asperity::web {

// Return the reason of a failure, or "". Load the part before files are hidden.
std::string load_system_call_filter();
std::string confine_system_calls(Confined as);

// Symbol `asperity_confine_system_calls` of the part: reason of a failure, or null.
using ConfineSystemCalls = const char*(Confined as);

}  // namespace asperity::web
