// SPDX-License-Identifier: GPL-3.0-or-later
// A command of the program: name, help, options and work, each in its own file. main() (bindings/main.cpp)
// has the list.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace asperity::cli {

// Returns the program's exit status.
using CommandWork = std::function<int()>;

// Called once, after parsing. Converts parsed texts and returns the work. Throws Error for a wrong option or
// combination (exit status bad_usage).
using CommandReader = std::function<CommandWork()>;

// The writer of standard output; decides about control characters (plain_streams.hpp).
enum class Prints {
  text,       // own text: no control characters on a terminal
  of_script,  // of a script: text and colours on a terminal, every byte elsewhere
  by_editor,  // libedit writes to the terminal itself
};

struct Command {
  std::string name;
  std::string sentence;  // without full stop
  std::string overview;  // lines in `asperity help`
  Prints prints = Prints::text;
  // `options` outlives the returned reader.
  std::function<CommandReader(CLI::App& options)> declare;
};

// Defined in the source file of the same name; the last three in information_commands.cpp.
Command accuracy_command();
Command cases_command();
Command check_command();
Command explain_command();
Command lesson_command();
Command press_log_command();
Command repl_command();
Command status_command();
// `overview`: returns the lines for `asperity help`.
Command help_command(std::string (*overview)());
Command materials_command();
Command version_command();

// Generated from the parser (command_pages.cpp). The manual page asperity(1) in man(7) macros:
std::string manual_page(const CLI::App& app, const std::string& version);
// Completion for bash:
std::string bash_completion(const CLI::App& app, const std::vector<std::string>& lessons);

}  // namespace asperity::cli
