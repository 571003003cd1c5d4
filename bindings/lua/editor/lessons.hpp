// SPDX-License-Identifier: GPL-3.0-or-later
// The lessons of scripts/lessons, built into the program: scripts that ask a question, want a prediction and
// end with a check that says why. What is told about a lesson stands in the comment that opens its script:
// the title in the first line, then `Question: ...`, `Predict: ...` and `Minutes: N`, each going on in the
// lines after it, and after an empty comment line the explanation as Markdown.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace asperity::lua {

struct Lesson {
  int number = 0;    // from 1, their order
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

// All lessons in their order. Read once; safe to call from any thread.
const std::vector<Lesson>& lessons();

// The lesson called so: by name ("tilt"), number ("6") or file ("06_tilt", "06_tilt.lua"). Throws
// Error{unknown_name} with the nearest name.
const Lesson& find_lesson(std::string_view called);

// What a script's opening comment tells. `stem` is "06_tilt". Throws Error{bad_file} where a part is missing.
Lesson read_lesson(std::string_view stem, std::string_view script);

}  // namespace asperity::lua
