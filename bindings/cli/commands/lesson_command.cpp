// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "bindings/cli/commands/run_command.hpp"
#include "bindings/cli/commands/shared_options.hpp"
#include "bindings/lua/editor/lessons.hpp"
#include "engine/core/require.hpp"

namespace asperity::cli {

namespace {

struct LessonCommand {
  std::string name;   // empty: list all
  bool copy = false;  // to the working directory
  bool run = false;
  std::string folder;  // of more lessons
  RunCommand options;  // of the run
};

// Wraps at 100 characters; indents later lines.
std::string in_lines(const std::string& text, std::size_t indent) {
  std::istringstream words(text);
  std::string result;
  std::size_t column = indent;
  for (std::string word; words >> word; column += word.size() + 1) {
    const bool wraps = column > indent && column + word.size() > 100;
    if (wraps) column = indent;
    if (!result.empty()) result += wraps ? "\n" + std::string(indent, ' ') : " ";
    result += word;
  }
  return result;
}

void list(const std::vector<lua::Lesson>& lessons, const std::string& option) {
  for (const lua::Lesson& lesson : lessons)
    if (!lesson.problem.empty())
      std::printf("%s is no lesson: %s\n", lesson.file.c_str(), lesson.problem.c_str());
    else
      std::printf("%d  %s: %s (%d min)\n   %s\n", lesson.number, lesson.name.c_str(), lesson.title.c_str(),
                  lesson.minutes, in_lines(lesson.question, 3).c_str());
  std::printf(
      "\nasperity lesson%s NAME          shows one\n"
      "asperity lesson%s NAME --copy   puts its script here, to be changed and run\n"
      "asperity lesson%s NAME --run    runs it as it is\n",
      option.c_str(), option.c_str(), option.c_str());
}

void copy(const lua::Lesson& lesson) {
  if (std::filesystem::exists(lesson.file))
    refuse_bad_file(quoted(lesson.file) + " is there already, and may have been changed",
                    "move it away, or run it: asperity run " + lesson.file);
  std::ofstream file(lesson.file, std::ios::binary);
  file << lesson.script;
  file.close();
  if (!file) refuse_bad_file(quoted(lesson.file) + " cannot be written here");
  std::printf("%s is here. Write your prediction into it, then: asperity run %s\n", lesson.file.c_str(),
              lesson.file.c_str());
}

// Status: of the run, or 0; 2 for an unknown lesson or an existing file.
int lesson(const LessonCommand& command, LessonsWith with) {
  const std::vector<lua::Lesson> all = with(command.folder);
  const std::string option = command.folder.empty() ? "" : " --lessons " + command.folder;
  if (command.name.empty()) {
    if (command.copy || command.run)
      refuse("no lesson was named", "name one, as in asperity lesson tilt; asperity lesson lists them");
    return list(all, option), 0;
  }
  const lua::Lesson& lesson = lua::find_lesson(command.name, all);
  if (command.copy) copy(lesson);
  if (command.run) {
    RunCommand run = command.options;
    run.script = lesson.file;
    run.text = std::string(lesson.script);
    return cli::run(run);
  }
  if (!command.copy)
    std::printf(
        "%s (%d minutes)\n\nQuestion: %s\n\nPredict: %s\n\n%s\nasperity lesson%s %s --copy   puts its "
        "script here, to be changed and run\n"
        "asperity lesson%s %s --run    runs it as it is\n",
        lesson.title.c_str(), lesson.minutes, in_lines(lesson.question, 0).c_str(),
        in_lines(lesson.predict, 0).c_str(), lesson.explanation.c_str(), option.c_str(), lesson.name.c_str(),
        option.c_str(), lesson.name.c_str());
  return 0;
}

CommandReader declare_lesson(CLI::App& options, LessonsWith with) {
  const auto given = std::make_shared<LessonCommand>();
  LessonCommand& asked = *given;
  options.add_option("name", asked.name, "a lesson, by name or number; without it they are listed");
  CLI::Option* copied =
      options.add_flag("--copy", asked.copy, "put its script into this folder, to be changed and run");
  options.add_flag("--run", asked.run, "run it as it is")->excludes(copied);
  options.add_option("--lessons", asked.folder, "a folder of lessons of your own, listed first")
      ->type_name("DIR")
      ->check(CLI::ExistingDirectory);
  add_run_options(options, asked.options);

  return [given, with]() -> CommandWork { return [given, with] { return lesson(*given, with); }; };
}

}  // namespace

Command lesson_command(LessonsWith with) {
  return {.name = "lesson",
          .sentence = "lessons that come with the program: lists them, shows one, copies or runs it",
          .overview =
              "asperity lesson [NAME]                         lessons: a question, a prediction, a run that "
              "tells why\n",
          .prints = Prints::of_script,
          .declare = [with](CLI::App& options) { return declare_lesson(options, with); }};
}

}  // namespace asperity::cli
