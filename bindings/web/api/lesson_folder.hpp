// SPDX-License-Identifier: GPL-3.0-or-later
// Lessons of a teacher's folder, read at each request. Links and files of other places are refused.
#pragma once

#include <filesystem>
#include <vector>

#include "bindings/lua/editor/lessons.hpp"

namespace asperity::web {

// Those of `folder` (none if empty) in the order of their files, then those of the program without a lesson
// of the same name in the folder. A file without a lesson in it has a `problem`. Texts of other languages are
// in folders of two letters, de/06_tilt.txt.
std::vector<lua::Lesson> lessons_with(const std::filesystem::path& folder);

}  // namespace asperity::web
