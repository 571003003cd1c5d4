// SPDX-License-Identifier: GPL-3.0-or-later
// Lessons: those of scripts/lessons are compiled in; others come from files of a teacher. The opening comment
// of a lesson is: title; `Question: ...`, `Predict: ...`, `Minutes: N` and perhaps `Code: hidden`, each
// possibly over several lines; an empty comment line; the explanation in Markdown; perhaps `Notes: ...` for
// the teacher. The text of another language is a file without code, de/06_tilt.txt: the same parts, then
// `Reason:`, `Answers:` and `Replies:`.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::lua {

// Markdown, except for the title. Empty parts are missing.
struct LessonTexts {
  std::string title, question, predict, explanation;
  std::string reason;                          // {1}, {2} … are the values in the script's reason
  std::map<std::string, std::string> answers;  // by name of a guess or by option; "note": the remark
  std::map<std::string, std::string> replies;  // by option
};

struct Lesson : LessonTexts {
  int number = 0;      // from 1
  std::string name;    // "tilt" of 06_tilt.lua
  std::string file;    // "06_tilt.lua"
  std::string script;  // without notes
  std::string notes;   // Markdown, for the teacher
  int minutes = 0;
  bool hides_code = false;
  std::map<std::string, LessonTexts> languages;  // by code: "de"
  std::string problem;                           // of a file that is no lesson
};

// In order; thread-safe.
const std::vector<Lesson>& lessons();

// By name ("tilt"), number ("6") or file ("06_tilt", "06_tilt.lua"). Throws Error{unknown_name} with the
// nearest name, Error{bad_file} for a file that is no lesson.
const Lesson& find_lesson(std::string_view called, const std::vector<Lesson>& all = lessons());

// `stem`: "06_tilt". Throws Error{bad_file} for a missing part or a mistake in Lua's grammar.
Lesson read_lesson(std::string_view stem, std::string_view script);
// The Lua script of a lesson in Markdown: `# Title`, paragraphs `Question: ...` and so on (the key perhaps
// **bold**), the explanation, one block ```lua, perhaps `Notes: ...`. Throws Error{bad_file} with `file`.
std::string script_of_markdown(std::string_view file, std::string_view text);
// Throws Error{bad_file}, with `file`, for a line that is no `NAME: text` under Answers or Replies.
LessonTexts read_lesson_texts(std::string_view file, std::string_view text);

}  // namespace asperity::lua
