// SPDX-License-Identifier: GPL-3.0-or-later
// The lessons of scripts/lessons, compiled into the program. The opening comment of a lesson has the title in
// its first line, then `Question: ...`, `Predict: ...` and `Minutes: N` (each may continue on the next
// lines), and after an empty comment line the explanation in Markdown.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace asperity::lua {

struct Lesson {
  int number = 0;    // from 1
  std::string name;  // "tilt" of 06_tilt.lua
  std::string file;  // "06_tilt.lua"
  std::string title;
  std::string question;
  std::string predict;
  int minutes = 0;
  std::string explanation;  // Markdown
  std::string text;         // question, prediction and explanation, as Markdown
  std::string_view script;
};

// In order. Loaded once; thread-safe.
const std::vector<Lesson>& lessons();

// Accepts a name ("tilt"), number ("6") or file ("06_tilt", "06_tilt.lua"). Throws Error{unknown_name} with
// the nearest name.
const Lesson& find_lesson(std::string_view called);

// Parses the opening comment. `stem` is "06_tilt". Throws Error{bad_file} if a part is missing.
Lesson read_lesson(std::string_view stem, std::string_view script);

}  // namespace asperity::lua
