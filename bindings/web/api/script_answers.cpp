// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/api/script_answers.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "bindings/lua/editor/completion.hpp"
#include "engine/core/error.hpp"

namespace asperity::web {

namespace {

std::optional<std::int64_t> line_in(const std::string& reached) {
  const std::string lead = "to line ";
  if (!reached.starts_with(lead)) return {};
  const std::int64_t line = std::strtoll(reached.c_str() + lead.size(), nullptr, 10);
  return line > 0 ? std::optional(line) : std::nullopt;
}

Json mark(const char* severity, const std::string& message, const Json* line) {
  return Json::object(
      {{"line", line == nullptr ? Json(1) : *line}, {"severity", severity}, {"message", message}});
}

// UTF-16 units; 0 for a continuation byte.
std::size_t units_of(char byte) {
  const auto bits = static_cast<unsigned char>(byte);
  return (bits & 0xC0) == 0x80 ? 0 : bits >= 0xF0 ? 2 : 1;
}

// Also in strings and comments. The parser recurses with brackets on a thread's finite stack.
std::size_t deepest_bracket(const std::string& text) {
  std::size_t depth = 0, deepest = 0;
  for (const char c : text) {
    if (c == '(' || c == '{' || c == '[') deepest = std::max(deepest, ++depth);
    if ((c == ')' || c == '}' || c == ']') && depth > 0) --depth;
  }
  return deepest;
}

Json json_of(const std::map<std::string, std::string>& texts) {
  Json json = Json::object();
  for (const auto& [name, text] : texts) json.set(name, text);
  return json;
}

// Without empty texts.
Json json_of(const lua::LessonTexts& texts) {
  Json json = Json::object();
  for (const auto& [name, text] : {std::pair{"title", &texts.title},
                                   {"question", &texts.question},
                                   {"predict", &texts.predict},
                                   {"text", &texts.explanation},
                                   {"reason", &texts.reason}})
    if (!text->empty()) json.set(name, *text);
  if (!texts.answers.empty()) json.set("answers", json_of(texts.answers));
  if (!texts.replies.empty()) json.set("replies", json_of(texts.replies));
  return json;
}

Json languages_of(const lua::Lesson& lesson) {
  Json languages = Json::object();
  for (const auto& [language, texts] : lesson.languages) languages.set(language, json_of(texts));
  return languages;
}

}  // namespace

Json note(const std::string& message) { return mark("note", message, nullptr); }

Json check_answer(const std::string& events) {
  Json::List marks, charts;
  Json answer = Json::object();
  bool ended = false;
  std::istringstream lines(events);
  for (std::string line; std::getline(lines, line);) {
    try {
      const Json event = Json::parse(line, "an event");
      const std::string& type = event["type"].string();
      if (type == "error") marks.push_back(mark("error", event["message"].string(), event.find("line")));
      if (type == "chart") charts.push_back(event);
      if (const Json* knobs = event.find("knobs"); knobs != nullptr && !knobs->members().empty())
        answer.set("knobs", *knobs);
      if (type != "ended" || event.find("why") == nullptr) continue;
      ended = true;
      if (const auto reached = line_in(event["why"].string())) answer.set("checked_to", *reached);
    } catch (const Error&) {
      continue;
    }
  }
  if (!charts.empty()) answer.set("charts", std::move(charts));
  if (ended || !marks.empty()) answer.set("marks", std::move(marks));
  return answer;
}

std::size_t byte_of_unit(std::string_view text, std::size_t unit) {
  std::size_t before = 0, begin = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const std::size_t units = units_of(text[k]);
    if (units == 0) continue;
    begin = k;
    if (before + units > unit) return begin;
    before += units;
  }
  return text.size();
}

std::size_t unit_of_byte(std::string_view text, std::size_t byte) {
  std::size_t units = 0;
  for (std::size_t k = 0; k < std::min(byte, text.size()); ++k) units += units_of(text[k]);
  return units;
}

Json completion_of(const std::string& text, std::size_t unit) {
  std::size_t from = byte_of_unit(text, unit);
  Json::List candidates;
  constexpr std::size_t longest = std::size_t{256} << 10;
  constexpr std::size_t deepest = 500;
  if (text.size() > longest || deepest_bracket(text) > deepest)
    return Json::object({{"from", unit}, {"candidates", candidates}});
  const lua::Completion completion = lua::complete(text, from);
  from = completion.from;
  for (const lua::Candidate& candidate : completion.candidates)
    candidates.push_back(Json::object({{"text", candidate.text},
                                       {"kind", candidate.kind},
                                       {"detail", candidate.detail},
                                       {"help", candidate.help}}));
  return Json::object({{"from", unit_of_byte(text, from)}, {"candidates", std::move(candidates)}});
}

Json lesson_entries(const std::vector<lua::Lesson>& lessons, bool for_teacher) {
  Json::List list;
  for (const lua::Lesson& lesson : lessons) {
    if (!lesson.problem.empty() && !for_teacher) continue;
    Json entry = Json::object({{"name", lesson.name},
                               {"number", lesson.number},
                               {"title", lesson.title},
                               {"question", lesson.question},
                               {"minutes", lesson.minutes},
                               {"languages", languages_of(lesson)}});
    if (!lesson.problem.empty()) entry.set("problem", lesson.problem);
    list.push_back(std::move(entry));
  }
  return list;
}

Json lesson_answer(const lua::Lesson& lesson, bool for_teacher) {
  Json answer = json_of(static_cast<const lua::LessonTexts&>(lesson));
  answer.set("name", lesson.name)
      .set("minutes", lesson.minutes)
      .set("script", lesson.script)
      .set("hides_code", lesson.hides_code)
      .set("languages", languages_of(lesson));
  if (for_teacher && !lesson.notes.empty()) answer.set("notes", lesson.notes);
  return answer;
}

}  // namespace asperity::web
