// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/sandbox/system_calls.hpp"

#include "engine/core/error.hpp"
#include "engine/core/loaded_part.hpp"

namespace asperity::web {

namespace {
ConfineSystemCalls* part = nullptr;
}

std::string load_system_call_filter() {
  try {
    part = part_function<ConfineSystemCalls>(
        {"sandbox", "the system calls of a script are filtered", "libseccomp2"},
        "asperity_confine_system_calls");
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

std::string confine_system_calls(Confined as) {
  if (part == nullptr) return "the part asperity-sandbox.so was not built; it needs libseccomp";
  const char* const problem = part(as);
  return problem == nullptr ? "" : problem;
}

}  // namespace asperity::web
