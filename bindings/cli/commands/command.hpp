// SPDX-License-Identifier: GPL-3.0-or-later
// A command of the program, such as `asperity run`: name, help, options and work. Each command is in its own
// file; main() (bindings/main.cpp) has the list of commands.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace asperity::cli {

// Executes the command; returns the program's exit status.
using CommandWork = std::function<int()>;

// Called once, after a command line with this command was parsed. Reads values from the parsed texts and
// returns the work. Throws Error for a wrong option or combination; the program then exits with bad_usage.
using CommandReader = std::function<CommandWork()>;

// The writer of standard output, which decides about control characters for a terminal (plain_streams.hpp).
enum class Prints {
  text,       // the program's own text: a terminal gets no control characters
  of_script,  // a script's output: a terminal gets text and colours; a pipe or file gets every byte
  by_editor,  // lines edited by libedit, which writes to the terminal itself
};

struct Command {
  std::string name;
  std::string sentence;  // for --help and the manual page, without full stop
  std::string overview;  // lines in `asperity help`
  Prints prints = Prints::text;
  // Adds the options. `options` outlives the returned reader.
  std::function<CommandReader(CLI::App& options)> declare;
};

// Each is defined in the source of its name; the last three in information_commands.cpp.
Command accuracy_command();
Command cases_command();
Command check_command();
Command explain_command();
Command lesson_command();
Command press_log_command();
Command repl_command();
Command status_command();
// `overview` returns the overview lines of all commands.
Command help_command(std::string (*overview)());
Command materials_command();
Command version_command();

// Pages generated from the parser (command_pages.cpp), so that they cannot disagree with it. The manual page
// asperity(1) in man(7) macros:
std::string manual_page(const CLI::App& app, const std::string& version);
// Bash completion: commands, their options, scripts, run directories, the given lessons:
std::string bash_completion(const CLI::App& app, const std::vector<std::string>& lessons);

}  // namespace asperity::cli
