// SPDX-License-Identifier: GPL-3.0-or-later
// Lessons of a teacher's folder, read at each request. Links and files of other places are refused.
#pragma once

#include <filesystem>
#include <vector>

#include "bindings/lua/editor/lessons.hpp"

namespace asperity::web {

// The lessons of `folder`, by file name, then the program's own lessons. A lesson of the folder replaces the
// program's lesson of its name. An empty `folder` gives the program's lessons. A faulty file is an entry with
// a `problem`. Texts of other languages are in folders of two letters, de/06_tilt.txt.
std::vector<lua::Lesson> lessons_with(const std::filesystem::path& folder);

}  // namespace asperity::web
