// SPDX-License-Identifier: GPL-3.0-or-later
// Folders of files that come with the program.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace asperity::web {

// The first existing: share/asperity/<installed> next to the bin of an installation, <build>/<built>,
// <sources>/<built>.
std::optional<std::filesystem::path> shared_folder(const std::string& installed, const std::string& built);

}  // namespace asperity::web
