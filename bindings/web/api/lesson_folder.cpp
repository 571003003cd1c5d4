// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/api/lesson_folder.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>

#include "bindings/web/sandbox/plain_files.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity::web {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_folder_entries = 300, most_lessons = 60,
                      most_lesson_bytes = std::size_t{128} << 10, longest_lesson_name = 60;

struct LessonNames {
  std::vector<std::string> files, languages;
  std::string problem;
};

LessonNames lesson_names(const fs::path& folder) {
  LessonNames names;
  std::error_code problem;
  std::size_t seen = 0;
  for (fs::directory_iterator at(folder, problem), end; !problem && at != end; at.increment(problem)) {
    const std::string name = at->path().filename().string();
    const bool is_lesson = (name.ends_with(".lua") || name.ends_with(".md")) && !name.starts_with('.');
    if (++seen > most_folder_entries || (is_lesson && names.files.size() == most_lessons)) {
      names.problem = asperity::quoted(folder.filename().string()) + " has more than " +
                      std::to_string(most_lessons) + " lessons or " + std::to_string(most_folder_entries) +
                      " files: use a folder of its own";
      break;
    }
    const bool letters = std::ranges::all_of(name, [](char c) { return c >= 'a' && c <= 'z'; });
    if (is_lesson) names.files.push_back(name);
    if (name.size() == 2 && letters) names.languages.push_back(name);
  }
  if (problem) names.problem = asperity::quoted(folder.string()) + " cannot be read: " + problem.message();
  std::ranges::sort(names.files);
  return names;
}

std::string text_in(const fs::path& folder, const std::string& name) {
  auto text = read_plain_file(folder, name, most_lesson_bytes);
  if (!text)
    refuse_bad_file(asperity::quoted(name) + " is a link, or cannot be read, or has over " +
                    std::to_string(most_lesson_bytes) + " bytes");
  return *std::move(text);
}

lua::Lesson broken(const std::string& file, const std::string& problem) {
  lua::Lesson lesson;
  lesson.name = lesson.file = lesson.title = file;
  lesson.problem = problem;
  return lesson;
}

lua::Lesson lesson_in(const fs::path& folder, const std::string& file) {
  try {
    const std::string text = text_in(folder, file), stem = file.substr(0, file.rfind('.'));
    lua::Lesson lesson =
        lua::read_lesson(stem, file.ends_with(".md") ? lua::script_of_markdown(file, text) : text);
    if (lesson.name.size() <= longest_lesson_name) return lesson;
    return broken(file, asperity::quoted(file) + " has a name of " + std::to_string(lesson.name.size()) +
                            " bytes; at most " + std::to_string(longest_lesson_name));
  } catch (const Error& error) {
    return broken(file, error.what());
  }
}

// Texts of other languages; a file with a fault is added to `faults`.
void add_texts(const fs::path& folder, const LessonNames& names, lua::Lesson& lesson,
               std::vector<lua::Lesson>& faults) {
  for (const std::string& language : names.languages) {
    const std::string file = language + "/" + lesson.file.substr(0, lesson.file.size() - 4) + ".txt";
    std::error_code ignored;
    if (!fs::exists(fs::symlink_status(folder / file, ignored))) continue;
    try {
      lesson.languages[language] = lua::read_lesson_texts(file, text_in(folder, file));
    } catch (const Error& error) {
      faults.push_back(broken(file, error.what()));
    }
  }
}

}  // namespace

std::vector<lua::Lesson> lessons_with(const fs::path& folder) {
  if (folder.empty()) return lua::lessons();
  std::vector<lua::Lesson> all, faults;
  const auto has = [&all](const std::string& name) {
    return std::ranges::find(all, name, &lua::Lesson::name) != all.end();
  };
  const LessonNames names = lesson_names(folder);
  for (const std::string& file : names.files) {
    lua::Lesson lesson = lesson_in(folder, file);
    if (has(lesson.name))
      lesson = broken(file, asperity::quoted(file) + " is a second lesson " + asperity::quoted(lesson.name) +
                                ": rename one");
    if (lesson.problem.empty()) add_texts(folder, names, lesson, faults);
    all.push_back(std::move(lesson));
  }
  if (!names.problem.empty()) faults.push_back(broken(folder.filename().string(), names.problem));
  std::ranges::move(faults, std::back_inserter(all));
  for (const lua::Lesson& lesson : lua::lessons())
    if (!has(lesson.name)) all.push_back(lesson);
  return all;
}

}  // namespace asperity::web
