// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/editor/lessons.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <memory>
#include <new>
#include <span>

#include "bindings/lua/registry/embedded.hpp"
#include "bindings/lua/registry/lua_api.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/text_table.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

namespace {

using LessonLines = std::vector<std::string>;

LessonLines lesson_lines(std::string_view text) {
  LessonLines lines;
  LineReader reader(text);
  for (std::string_view line; reader.next(line);) lines.emplace_back(line);
  return lines;
}

// Without blanks and empty lines around it.
std::string without_margins(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\n");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t\n") + 1 - first));
}

struct LessonParts {
  std::string title;
  std::map<std::string, std::string> of;  // by key; "": the explanation
  std::vector<bool> is_note;              // by line
};

using LessonKeys = std::span<const char* const>;
constexpr std::array in_lesson_head{"Question", "Predict", "Minutes", "Code", "Notes"};
constexpr std::array after_lesson{"Notes"};
constexpr std::array after_text{"Reason", "Answers", "Replies"};

// The key at the beginning of a line, in any case; "" if none. `at` is behind its colon.
std::string lesson_key(const std::string& line, LessonKeys keys, std::size_t& at) {
  at = line.find(':') + 1;
  const std::string begin = lower_case(std::string_view(line).substr(0, std::max<std::size_t>(at, 1) - 1));
  const auto found = std::ranges::find_if(keys, [&](const char* key) { return lower_case(key) == begin; });
  return found == keys.end() ? "" : *found;
}

// A part of the head is one paragraph. A later part extends to the next key or the end.
LessonParts lesson_parts(const LessonLines& lines, LessonKeys later) {
  LessonParts parts;
  std::string key;
  bool head = true;
  for (const std::string& line : lines) {
    std::size_t at = 0;
    if (parts.is_note.empty()) {
      parts.title = without_margins(line);
    } else if (head && without_margins(line).empty()) {
      head = false;
      key.clear();
    } else if (const std::string begun = lesson_key(line, head ? LessonKeys(in_lesson_head) : later, at);
               !begun.empty()) {
      key = begun;
      parts.of[key] = line.substr(at);
    } else if (!head || !key.empty()) {
      parts.of[key] += head ? " " + without_margins(line) : "\n" + line;
    }
    parts.is_note.push_back(key == "Notes");
  }
  for (auto& [name, text] : parts.of) text = without_margins(text);
  return parts;
}

LessonTexts lesson_texts(LessonParts& parts) {
  LessonTexts texts;
  texts.title = parts.title;
  texts.question = parts.of["Question"];
  texts.predict = parts.of["Predict"];
  texts.reason = parts.of["Reason"];
  texts.explanation = parts.of[""];
  if (!texts.explanation.empty()) texts.explanation += "\n";
  return texts;
}

// `text`: lines `name: text`, continued by indented lines.
std::map<std::string, std::string> named_texts(std::string_view file, const std::string& text) {
  std::map<std::string, std::string> named;
  std::string* last = nullptr;
  for (const std::string& line : lesson_lines(text)) {
    const std::size_t colon = line.find(':');
    if (line.starts_with(' ') && last != nullptr) {
      *last += " " + without_margins(line);
    } else if (colon != std::string::npos && colon > 0) {
      last = &(named[line.substr(0, colon)] = without_margins(line.substr(colon + 1)));
    } else if (!without_margins(line).empty()) {
      refuse_bad_file(quoted(file) + " has a line " + quoted(line),
                      "give an answer as `name: text`; indent its further lines");
    }
  }
  return named;
}

void check_lesson_grammar(const std::string& file, std::string_view script) {
  const std::unique_ptr<lua_State, decltype(&lua_close)> state(luaL_newstate(), lua_close);
  if (state == nullptr) throw std::bad_alloc();
  if (luaL_loadbufferx(state.get(), script.data(), script.size(), ("=" + file).c_str(), "t") != LUA_OK)
    refuse_bad_file(lua_tostring(state.get(), -1), "`asperity check` explains it");
}

void check_lesson(const Lesson& lesson, const std::string& code) {
  for (const auto& [what, missing] :
       {std::pair{"a title in its first line", lesson.title.empty()},
        {"a line `-- Question: ...`", lesson.question.empty()},
        {"a line `-- Predict: ...`", lesson.predict.empty()},
        {"a line `-- Minutes: N`", lesson.minutes <= 0},
        {"an explanation after an empty comment line", lesson.explanation.empty()}})
    if (missing)
      refuse_bad_file("the lesson " + quoted(lesson.file) + " lacks " + what,
                      "its opening comment says what it is about");
  if (!code.empty() && code != "hidden")
    refuse_bad_file("the lesson " + quoted(lesson.file) + " has `Code: " + code + "`",
                    "say `Code: hidden`, or leave the line out");
}

}  // namespace

Lesson read_lesson(std::string_view stem, std::string_view script) {
  Lesson lesson;
  lesson.file = std::string(stem) + ".lua";
  const auto [rest, problem] = std::from_chars(stem.data(), stem.data() + stem.size(), lesson.number);
  if (problem != std::errc() || rest == stem.data() + stem.size() || *rest != '_')
    refuse_bad_file("the lesson " + quoted(stem) + " has no number", "call its file such as 06_tilt.lua");
  lesson.name = std::string(rest + 1, stem.data() + stem.size());

  const LessonLines lines = lesson_lines(script);
  LessonLines opening;  // without dashes
  for (const std::string& line : lines) {
    if (!line.starts_with("--")) break;
    opening.push_back(line.substr(line.starts_with("-- ") ? 3 : 2));
  }
  LessonParts parts = lesson_parts(opening, after_lesson);
  static_cast<LessonTexts&>(lesson) = lesson_texts(parts);
  lesson.notes = parts.of["Notes"];
  lesson.hides_code = parts.of["Code"] == "hidden";
  const std::string& minutes = parts.of["Minutes"];
  std::from_chars(minutes.data(), minutes.data() + minutes.size(), lesson.minutes);
  check_lesson(lesson, parts.of["Code"]);
  check_lesson_grammar(lesson.file, script);
  for (std::size_t k = 0; k < lines.size(); ++k)
    if (k >= opening.size() || !parts.is_note[k]) lesson.script += lines[k] + "\n";
  return lesson;
}

std::string script_of_markdown(std::string_view file, std::string_view text) {
  std::string head, code;
  int blocks = 0;
  bool in_code = false, in_head = true, paragraph = false;
  for (std::string line : lesson_lines(text)) {
    if (in_code && line == "```") {
      in_code = false;
    } else if (in_code) {
      code += line + "\n";
    } else if (line == "```lua") {
      in_code = true;
      ++blocks;
    } else {
      if (head.empty() && line.starts_with("# ")) line.erase(0, 2);
      if (line.starts_with("**"))
        if (const std::size_t end = line.find(":**"); end != std::string::npos)
          line = line.substr(2, end - 1) + line.substr(end + 3);
      std::size_t at = 0;
      const bool blank = without_margins(line).empty();
      const bool key = !lesson_key(line, in_lesson_head, at).empty();
      // Blank lines separate the paragraphs of the head; the first other paragraph ends the head.
      if (in_head && !head.empty() && !blank && !key && !paragraph) {
        head += "--\n";
        in_head = false;
      }
      paragraph = !blank && !head.empty();
      if (!in_head || !blank) head += blank ? "--\n" : "-- " + line + "\n";
    }
  }
  if (blocks != 1 || in_code)
    refuse_bad_file(in_code ? quoted(file) + " has a block ```lua without its end ```"
                            : quoted(file) + " has " + std::to_string(blocks) + " blocks ```lua",
                    "a lesson in Markdown has its script in one block ```lua");
  return head + "\n" + code;
}

LessonTexts read_lesson_texts(std::string_view file, std::string_view text) {
  LessonParts parts = lesson_parts(lesson_lines(text), after_text);
  LessonTexts texts = lesson_texts(parts);
  texts.answers = named_texts(file, parts.of["Answers"]);
  texts.replies = named_texts(file, parts.of["Replies"]);
  return texts;
}

const std::vector<Lesson>& lessons() {
  static const std::vector<Lesson> all = [] {
    std::vector<Lesson> found;
    for (const EmbeddedScript& script : embedded_lessons())
      found.push_back(read_lesson(script.name, script.text));
    for (const EmbeddedScript& text : embedded_lesson_texts()) {
      const std::size_t slash = text.name.find('/');
      const std::string file = std::string(text.name.substr(slash + 1)) + ".lua";
      std::ranges::find(found, file, &Lesson::file)->languages[std::string(text.name.substr(0, slash))] =
          read_lesson_texts(text.name, text.text);
    }
    return found;
  }();
  return all;
}

const Lesson& find_lesson(std::string_view called, const std::vector<Lesson>& all) {
  std::vector<std::string> names;
  for (const Lesson& lesson : all) {
    if (!lesson.problem.empty()) {
      if (called == lesson.file) refuse_bad_file(lesson.problem);
      continue;
    }
    const std::string stem = lesson.file.substr(0, lesson.file.size() - 4);
    if (called == lesson.name || called == lesson.file || called == stem ||
        called == std::to_string(lesson.number))
      return lesson;
    names.push_back(lesson.name);
  }
  refuse_name("there is no lesson " + quoted(called) + did_you_mean(std::string(called), names),
              "the lessons are " + joined(names, " and "));
}

}  // namespace asperity::lua
