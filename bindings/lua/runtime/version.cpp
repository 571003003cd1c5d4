// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/runtime/version.hpp"

#include "bindings/lua/registry/lua_api.hpp"

namespace asperity::lua {

std::string version_text() { return ASPERITY_VERSION; }

std::vector<std::pair<std::string, std::string>> version_facts() {
  return {{"asperity", version_text()}, {"build", ASPERITY_BUILD_TYPE},  {"compiler", ASPERITY_COMPILER},
          {"lua", LUA_RELEASE},         {"fftw", ASPERITY_FFTW_VERSION}, {"eigen", ASPERITY_EIGEN_VERSION}};
}

}  // namespace asperity::lua
