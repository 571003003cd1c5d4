// SPDX-License-Identifier: GPL-3.0-or-later
// Folders of files that come with the program: share/asperity beside the bin it was installed in, and for a
// program in the folder it was built in, that folder and the sources.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace asperity::web {

// share/asperity/<installed>, or <build>/<built>, or <sources>/<built>; the first that is there.
std::optional<std::filesystem::path> shared_folder(const std::string& installed, const std::string& built);

}  // namespace asperity::web
