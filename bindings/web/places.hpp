// SPDX-License-Identifier: GPL-3.0-or-later
// Folders of files that come with the program: share/asperity next to the bin of an installation; for a
// program in its build folder, this folder and the sources.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace asperity::web {

// The first that exists: share/asperity/<installed>, <build>/<built>, <sources>/<built>.
std::optional<std::filesystem::path> shared_folder(const std::string& installed, const std::string& built);

}  // namespace asperity::web
