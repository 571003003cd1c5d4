// SPDX-License-Identifier: GPL-3.0-or-later
// A command of the program, as in `asperity run`: its name, what the pages of help say of it, its options,
// and what carries it out. Each declares all of this in a file of its own, and main() (bindings/main.cpp)
// walks a list of them, so that a command more is a file more, its line here and a line of that list.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace asperity::cli {

// Carries a command out. Returns the exit status of the program.
using CommandWork = std::function<int()>;

// Called once, after a command line that names the command was parsed: reads what the parser left as text,
// and returns what carries the command out. Throws Error where an option is wrong or does not go with
// another; the program then says so, and its exit status is bad_usage.
using CommandReader = std::function<CommandWork()>;

// The writer of standard output: it decides what a terminal may receive (plain_streams.hpp).
enum class Prints {
  text,       // of the program, with what scripts and files hold: a terminal obeys none of that
  of_script,  // prints of a script: a terminal gets text and colours, a program or a file gets every byte
  by_editor,  // lines that libedit edits, which writes to the terminal by itself
};

struct Command {
  std::string name;
  std::string sentence;  // in --help and on the manual page, without its full stop
  std::string overview;  // its lines of `asperity help`
  Prints prints = Prints::text;
  // Adds its options to its own part of the parser, which outlives what is returned.
  std::function<CommandReader(CLI::App& options)> declare;
};

// Commands that show nobody else what they do, each defined in the source of its name; the last three in
// information_commands.cpp.
Command accuracy_command();
Command cases_command();
Command check_command();
Command explain_command();
Command lesson_command();
Command press_log_command();
Command repl_command();
Command status_command();
// `overview` is asked for the lines of all commands, which `asperity help` begins with.
Command help_command(std::string (*overview)());
Command materials_command();
Command version_command();

// Pages made from the command line as the program reads it (command_pages.cpp), so that they cannot say
// anything else. The manual page asperity(1), in the macros of man(7), …
std::string manual_page(const CLI::App& app, const std::string& version);
// … and what a shell, bash, completes: commands, the options of each, scripts, run directories, these
// lessons.
std::string bash_completion(const CLI::App& app, const std::vector<std::string>& lessons);

}  // namespace asperity::cli
