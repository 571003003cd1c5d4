// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/places.hpp"

#include <system_error>
#include <vector>

namespace asperity::web {

namespace fs = std::filesystem;

std::optional<fs::path> shared_folder(const std::string& installed, const std::string& built) {
  std::error_code problem;
  const fs::path own = fs::canonical("/proc/self/exe", problem).parent_path();
  if (problem) return {};
  std::vector<fs::path> places{(own / "../share/asperity" / installed).lexically_normal()};
  if (fs::canonical(ASPERITY_BUILD_FOLDER, problem) == own && !problem) {
    places.push_back(own / built);
    places.push_back(fs::path(ASPERITY_SOURCE_FOLDER) / built);
  }
  for (const fs::path& place : places)
    if (fs::is_directory(place, problem)) return place;
  return {};
}

}  // namespace asperity::web
