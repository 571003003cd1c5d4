// SPDX-License-Identifier: GPL-3.0-or-later
// asperity: the program. main() lists the commands; each declares and reads its options in its own file
// (cli/commands, web/serve_command.cpp; interface in cli/commands/command.hpp). Commands of the command line
// receive the confined runners of the web part here, so that the command line includes no file of the page.
#include <unistd.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/cli/commands/command.hpp"
#include "bindings/cli/commands/replay_command.hpp"
#include "bindings/cli/commands/run_command.hpp"
#include "bindings/cli/plain_streams.hpp"
#include "bindings/lua/runtime/version.hpp"
#include "bindings/web/api/lesson_folder.hpp"
#include "bindings/web/confined/confined_command.hpp"
#include "bindings/web/serve_command.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace {

using namespace asperity;

// `place`: line in `asperity help`, where commands with a script form one group.
struct Listed {
  int place;
  cli::Command command;
};

std::string overview();

// Order of --help, the manual page and shell completion.
const std::vector<Listed>& commands() {
  static const std::vector<Listed> all{
      {1, cli::run_command({web::to_be_confined, web::run_behind_barriers})},
      {2, cli::replay_command({web::to_be_confined, web::replay_behind_barriers})},
      {3, cli::press_log_command()},
      {8, cli::accuracy_command()},
      {10, web::serve_command()},
      {4, cli::check_command()},
      {5, cli::explain_command()},
      {6, cli::cases_command()},
      {7, cli::status_command()},
      {9, cli::repl_command()},
      {11, cli::lesson_command(web::lessons_with)},
      {12, cli::help_command(overview)},
      {13, cli::materials_command()},
      {14, cli::version_command()},
  };
  return all;
}

std::string overview() {
  std::vector<Listed> in_place = commands();
  std::ranges::sort(in_place, {}, &Listed::place);
  std::string text;
  for (const Listed& listed : in_place) text += listed.command.overview;
  return text;
}

// A terminal must not obey escape sequences from scripts and files. Standard output of a script passes
// unchanged to a program or a file. At the prompt, libedit writes to the terminal itself.
void make_streams_plain(std::string_view word) {
  const auto named = std::ranges::find(
      commands(), word, [](const Listed& listed) -> std::string_view { return listed.command.name; });
  const cli::Prints prints = named != commands().end() ? named->command.prints : cli::Prints::text;
  const bool of_script = prints == cli::Prints::of_script;
  cli::make_errors_plain();
  if (prints == cli::Prints::by_editor || (of_script && ::isatty(STDOUT_FILENO) == 0)) return;
  cli::make_output_plain(of_script ? cli::Keeps::colours : cli::Keeps::text);
}

// Prints messages of the parser through the filtered streams.
int parser_exit(const CLI::App& app, const CLI::Error& error) {
  std::ostringstream out, err;
  const int status = app.exit(error, out, err);
  std::fputs(out.str().c_str(), stdout);
  std::fputs(err.str().c_str(), stderr);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  // The confined child process ignores all other arguments.
  if (argc == 2 && std::string_view(argv[1]) == "--confined") return web::confined_main();

  make_streams_plain(argc > 1 ? argv[1] : "");

  CLI::App app{"Asperity: a laboratory for rough surfaces, scripted in Lua."};
  app.name("asperity");
  app.require_subcommand(1);
  app.set_help_flag("-h,--help", "show this help");
  app.set_version_flag("--version", "asperity " + lua::version_text());
  std::vector<std::string> names;
  std::vector<std::pair<const CLI::App*, cli::CommandReader>> readers;
  for (const auto& [place, command] : commands()) {
    CLI::App& options = *app.add_subcommand(command.name, command.sentence);
    names.push_back(command.name);
    readers.emplace_back(&options, command.declare(options));
  }

  // The parser has no suggestion for an unknown command.
  if (argc > 1 && argv[1][0] != '-' && std::ranges::find(names, argv[1]) == names.end()) {
    std::fprintf(stderr, "asperity: there is no command %s%s; the commands are %s\n", quoted(argv[1]).c_str(),
                 did_you_mean(argv[1], names).c_str(), joined(names, " and ").c_str());
    return cli::bad_usage;
  }

  try {
    app.parse(argc, argv);
    for (const auto& [options, read] : readers)
      if (options->parsed()) return read()();
  } catch (const CLI::Success& success) {
    return parser_exit(app, success);
  } catch (const CLI::ParseError& error) {
    parser_exit(app, error);
    return cli::bad_usage;
  } catch (const std::exception& error) {
    return cli::refused(error);
  }
  return cli::bad_usage;
}
