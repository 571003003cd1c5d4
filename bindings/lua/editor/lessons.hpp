// SPDX-License-Identifier: GPL-3.0-or-later
// Lessons of scripts/lessons, compiled in. The opening comment of a lesson is: title; `Question: ...`,
// `Predict: ...` and `Minutes: N`, each possibly over several lines; an empty comment line; the explanation
// in Markdown.
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
  std::string text;         // Markdown: question, prediction, explanation
  std::string_view script;
};

// In order; thread-safe.
const std::vector<Lesson>& lessons();

// By name ("tilt"), number ("6") or file ("06_tilt", "06_tilt.lua"). Throws Error{unknown_name} with the
// nearest name.
const Lesson& find_lesson(std::string_view called);

// `stem`: "06_tilt". Throws Error{bad_file} for a missing part.
Lesson read_lesson(std::string_view stem, std::string_view script);

}  // namespace asperity::lua
