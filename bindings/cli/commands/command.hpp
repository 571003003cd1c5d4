// SPDX-License-Identifier: GPL-3.0-or-later
// A command of the program: name, help, options and work, each in its own file.
#pragma once

#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}
namespace asperity::lua {
struct Lesson;
}

namespace asperity::cli {

inline constexpr int done = 0, failed = 1, bad_usage = 2;
inline constexpr int cases_missing = 3;    // missing in the store
inline constexpr int another_version = 3;  // recorded the replayed run

// Prints the error.
inline int refused(const std::exception& error) {
  std::fprintf(stderr, "asperity: %s\n", error.what());
  return bad_usage;
}

// Returns the program's exit status; on an exception main() returns bad_usage.
using CommandWork = std::function<int()>;

// Called once, after parsing. Converts parsed texts and returns the work. Throws Error for a wrong option or
// combination (exit status bad_usage).
using CommandReader = std::function<CommandWork()>;

// Writer of standard output; decides about control characters.
enum class Prints {
  text,       // no control characters on a terminal
  of_script,  // on a terminal text and colours only
  by_editor,  // by libedit itself
};

struct Command {
  std::string name;
  std::string sentence;  // without full stop
  std::string overview;  // lines in `asperity help`
  Prints prints = Prints::text;
  // `options` outlives the reader.
  std::function<CommandReader(CLI::App& options)> declare;
};

// In the source file of the same name; the last three in information_commands.cpp.
Command accuracy_command();
Command cases_command();
Command check_command();
Command explain_command();
// `with`: the lessons of a teacher's folder, then the program's own; "": the program's own.
using LessonsWith = std::vector<lua::Lesson> (*)(const std::filesystem::path& folder);
Command lesson_command(LessonsWith with);
Command press_log_command();
Command repl_command();
Command status_command();
// `overview` returns the lines.
Command help_command(std::string (*overview)());
Command materials_command();
Command version_command();

}  // namespace asperity::cli
