// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/runtime/version.hpp"

#include "bindings/lua/registry/lua_api.hpp"
#include "engine/core/program_identity.hpp"

namespace asperity::lua {

std::string version_text() { return ASPERITY_VERSION; }

std::vector<std::pair<std::string, std::string>> version_facts() {
  std::string vectors = std::to_string(vector_bytes()) + " bytes";
  if (const std::string_view level = vector_level(); !level.empty())
    vectors += " (" + std::string(level) + ")";
  return {{"asperity", version_text()},
          {"build", ASPERITY_BUILD_TYPE},
          {"compiler", ASPERITY_COMPILER},
          {"vectors", vectors},
          {"lua", LUA_RELEASE},
          {"fftw", ASPERITY_FFTW_VERSION " (grids over MPI ranks only)"},
          {"eigen", ASPERITY_EIGEN_VERSION}};
}

Json version_json() {
  Json versions = Json::object();
  for (const auto& [name, version] : version_facts()) versions.set(name, version);
  return versions;
}

}  // namespace asperity::lua
