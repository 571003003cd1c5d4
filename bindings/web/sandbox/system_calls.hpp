// SPDX-License-Identifier: GPL-3.0-or-later
// The system call filter, made with libseccomp: an allow list for computations; all other calls fail. The
// filter is the part asperity-sandbox.so (bindings/web/seccomp).
#pragma once

#include <string>

#include "bindings/web/sandbox/confinement.hpp"

namespace asperity::web {

// Each returns the reason of a failure, or "". load_system_call_filter() must load the part before files are
// hidden.
std::string load_system_call_filter();
std::string confine_system_calls(Confined as);

// The part's symbol `asperity_confine_system_calls`: the reason of a failure, or null.
using ConfineSystemCalls = const char*(Confined as);

}  // namespace asperity::web
