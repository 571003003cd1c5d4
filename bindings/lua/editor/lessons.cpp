// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/editor/lessons.hpp"

#include <charconv>
#include <map>

#include "bindings/lua/registry/embedded.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

namespace {

// Without dashes.
std::vector<std::string> opening_comment(std::string_view script) {
  std::vector<std::string> lines;
  while (script.starts_with("--")) {
    const std::size_t end = std::min(script.find('\n'), script.size());
    std::string_view line = script.substr(2, end - 2);
    if (line.starts_with(' ')) line.remove_prefix(1);
    lines.emplace_back(line);
    script.remove_prefix(std::min(end + 1, script.size()));
  }
  return lines;
}

std::string trimmed(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ') || text.ends_with('\r')) text.remove_suffix(1);
  return std::string(text);
}

}  // namespace

Lesson read_lesson(std::string_view stem, std::string_view script) {
  Lesson lesson;
  lesson.script = script;
  lesson.file = std::string(stem) + ".lua";
  const auto [rest, problem] = std::from_chars(stem.data(), stem.data() + stem.size(), lesson.number);
  if (problem != std::errc() || rest == stem.data() + stem.size() || *rest != '_')
    throw Error(ErrorCode::bad_file, "the lesson " + quoted(stem) + " has no number",
                "call its file such as 06_tilt.lua");
  lesson.name = std::string(rest + 1, stem.data() + stem.size());

  const std::vector<std::string> lines = opening_comment(script);
  std::map<std::string, std::string> parts;
  std::size_t at = lines.empty() ? 0 : 1;
  std::string* part = nullptr;
  for (; at < lines.size() && !trimmed(lines[at]).empty(); ++at) {
    bool begins = false;
    for (const char* key : {"Question", "Predict", "Minutes"})
      if (lines[at].starts_with(std::string(key) + ":")) {
        part = &(parts[key] = trimmed(std::string_view(lines[at]).substr(std::string_view(key).size() + 1)));
        begins = true;
      }
    if (!begins && part != nullptr) *part += " " + trimmed(lines[at]);
  }
  std::string body;
  for (++at; at < lines.size(); ++at) body += lines[at] + "\n";
  while (body.ends_with("\n\n")) body.pop_back();

  if (!lines.empty()) lesson.title = trimmed(lines[0]);
  lesson.question = parts["Question"];
  lesson.predict = parts["Predict"];
  const std::string& minutes = parts["Minutes"];
  std::from_chars(minutes.data(), minutes.data() + minutes.size(), lesson.minutes);
  for (const auto& [what, missing] : {std::pair{"a title in its first line", lesson.title.empty()},
                                      {"a line `-- Question: ...`", lesson.question.empty()},
                                      {"a line `-- Predict: ...`", lesson.predict.empty()},
                                      {"a line `-- Minutes: N`", lesson.minutes <= 0},
                                      {"an explanation after an empty comment line", body.empty()}})
    if (missing)
      throw Error(ErrorCode::bad_file, "the lesson " + quoted(lesson.file) + " lacks " + what,
                  "its opening comment says what it is about");
  lesson.explanation = body;
  lesson.text = "Question: " + lesson.question + "\n\nPredict: " + lesson.predict + "\n\n" + body;
  return lesson;
}

const std::vector<Lesson>& lessons() {
  static const std::vector<Lesson> all = [] {
    std::vector<Lesson> found;
    for (const EmbeddedScript& script : embedded_lessons())
      found.push_back(read_lesson(script.name, script.text));
    return found;
  }();
  return all;
}

const Lesson& find_lesson(std::string_view called) {
  std::vector<std::string> names;
  for (const Lesson& lesson : lessons()) {
    const std::string stem = lesson.file.substr(0, lesson.file.size() - 4);
    if (called == lesson.name || called == lesson.file || called == stem ||
        called == std::to_string(lesson.number))
      return lesson;
    names.push_back(lesson.name);
  }
  throw Error(ErrorCode::unknown_name,
              "there is no lesson " + quoted(called) + did_you_mean(std::string(called), names),
              "the lessons are " + joined(names, " and "));
}

}  // namespace asperity::lua
