// SPDX-License-Identifier: GPL-3.0-or-later
// asperity: the command line. Each command is a few lines here and a file of its own where it has
// more to do.
#include <unistd.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/cli/accuracy_command.hpp"
#include "bindings/cli/check_command.hpp"
#include "bindings/cli/command_pages.hpp"
#include "bindings/cli/exit_status.hpp"
#include "bindings/cli/lesson_command.hpp"
#include "bindings/cli/plain_streams.hpp"
#include "bindings/cli/repl_command.hpp"
#include "bindings/cli/replay_command.hpp"
#include "bindings/cli/run_command.hpp"
#include "bindings/cli/shard.hpp"
#include "bindings/lua/editor/help.hpp"
#include "bindings/lua/editor/lessons.hpp"
#include "bindings/lua/runtime/version.hpp"
#include "bindings/web/confined.hpp"
#include "bindings/web/confined_command.hpp"
#include "bindings/web/serve_command.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/material.hpp"

namespace {

using namespace asperity;
using cli::bad_usage;

void print_materials() {
  std::printf("%-9s %-10s %-6s %-10s %-11s %s\n", "name", "E", "nu", "hardness", "density", "source");
  for (const Material& m : named_materials()) {
    auto shown = [](const std::optional<double>& value, Dimension dimension) {
      return value ? format_quantity(*value, dimension) : std::string("-");
    };
    std::printf(
        "%-9s %-10s %-6s %-10s %-11s %s\n", m.name.c_str(), shown(m.young, dimension::pressure).c_str(),
        m.poisson ? format_short(*m.poisson).c_str() : "-", shown(m.hardness, dimension::pressure).c_str(),
        m.density ? (format_short(*m.density) + " kg/m3").c_str() : "-", m.source.c_str());
  }
}

constexpr const char* usage =
    "asperity run SCRIPT [options] [-- arguments]   run a script and keep what it finds\n"
    "asperity run --resume RUN                      go on with a run that was cut off\n"
    "asperity replay RUN                            run a recorded run again and compare\n"
    "asperity check SCRIPT                          look for mistakes without running it\n"
    "asperity explain SCRIPT                        what it will compute, and at what cost\n"
    "asperity accuracy SCRIPT [options]              what accuracy costs a script that returns a number\n"
    "asperity repl [options]                        try things line by line\n"
    "asperity serve [options]                       open the laboratory as a page, for one or for a room\n"
    "asperity lesson [NAME]                         lessons: a question, a prediction, a run that tells why\n"
    "asperity help [TOPIC]                          explain the language\n"
    "asperity materials                             list the materials known by name\n"
    "asperity version                               show what this program was built with\n"
    "\nEach command explains itself with --help.\n\n";

int print_help(const std::string& topic, bool reference, bool types) {
  if (reference) return std::fputs(lua::reference_page().c_str(), stdout), 0;
  if (types) return std::fputs(lua::editor_types().c_str(), stdout), 0;
  if (topic.empty()) std::fputs(usage, stdout);
  try {
    std::fputs(lua::help_text(topic).c_str(), stdout);
  } catch (const Error& error) {
    std::fprintf(stderr, "asperity: %s\n", error.what());
    return bad_usage;
  }
  return 0;
}

double exact_value(const std::string& text) {
  try {
    return parse_quantity(text).value;
  } catch (const Error& error) {
    throw Error(error.code(), "the truth is " + quoted(text) + ": " + error.sentence(),
                "give a number, or a quantity such as \"0.1 um\"");
  }
}

void add_seed(CLI::App& command, std::uint64_t& seed) {
  command.add_option("--seed", seed, "of math.random (default 1)")
      ->check(CLI::Validator(
          [](const std::string& text) {
            const bool whole = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
            return whole && (text.size() < 19) ? std::string() : "a seed is a whole number from 0 to 10^18";
          },
          "WHOLE NUMBER"));
}

CLI::Option* add_script_options(CLI::App& command, cli::RunCommand& run, std::string& limit_time) {
  CLI::Option* script = command.add_option("script", run.script, "the Lua script")->required();
  add_seed(command, run.seed);
  command.add_option("--limit-time", limit_time, "end the run after this long, e.g. 60s or \"2 min\"");
  command.add_option("arguments", run.arguments, "reach the script as ... and arg; put them after --");
  return script;
}

void add_machine_options(CLI::App& command, int& threads, std::string& memory) {
  command.add_option("--threads", threads, "threads to use (default: one per processor)")
      ->check(CLI::Range(1, 4096));
  command.add_option("--limit-memory", memory, "most memory, e.g. 4G");
}

void add_run_options(CLI::App& command, cli::RunCommand& run, std::string& memory) {
  command.add_option("--out", run.out, "the run directory (default runs/<script>-<n>); must be new or empty");
  add_machine_options(command, run.threads, memory);
}

void add_store_options(CLI::App& command, cli::RunCommand& run, std::string& limit, std::string& shard) {
  CLI::Option* resume = command.add_option(
      "--resume", run.resume,
      "go on with the run in this directory where it was cut off; its script, arguments and seed are its own "
      "(a directory that is not there yet is begun)");
  resume->excludes(command.get_option("--out"));
  command
      .add_option("--reuse", run.reuse,
                  "take the results of heavy calls that are the same from this run; may be given again")
      ->allow_extra_args(false);  // one value each time: the next word may be the script
  command.add_option("--store-limit", limit,
                     "most bytes of results to keep for this, e.g. 20G (default 8G); 0 keeps none");
  command.add_option(
      "--store", run.store,
      "keep results in this folder and find them there, instead of RUN/store; several runs, on "
      "several machines, may share it at the same time (no limit unless --store-limit is given)");
  command
      .add_option(
          "--shard", shard,
          "i/n: compute the cases i, i+n, i+2n, ... of every ensemble and keep them in the folder given "
          "by --store; slurm: i and n are those of this task of a job array. The script goes on past an "
          "ensemble once all its cases are there, and else ends. A run without --shard puts all together")
      ->needs(command.get_option("--store"))
      ->excludes(command.get_option("--trust"));
}

void add_serve_options(CLI::App& command, web::ServeCommand& serve, std::string& time, std::string& memory) {
  command.add_option("--port", serve.port, "of the address (default 8137, or any where that is taken)")
      ->check(CLI::Range(1, 65535));
  command.add_flag("--open", serve.open, "open the page in this machine's browser");
  command.add_option("--out", serve.out,
                     "where its runs are kept (default runs/serve-<n>); must be new or empty");
  command
      .add_option("--runs", serve.runs, "scripts that run at once (default 2; in a room one per processor)")
      ->check(CLI::Range(1, 256));
  command.add_option("--limit-time", time, "of one run (default 10 min; in a room 60 s)");
  command.add_option("--limit-memory", memory, "of one run (default: its share of half the machine's)");
  CLI::Option* room = command.add_option("--classroom", serve.classroom,
                                         "serve a room on this address of the machine, with a key for each "
                                         "student; without it only this machine is");
  CLI::Option* students =
      command.add_option("--students", serve.students, "of the room")->check(CLI::Range(1, 400))->needs(room);
  command.add_option("--names", serve.names, "a file of the students' names, one per line")
      ->needs(room)
      ->excludes(students);
  command.footer(
      "Each run is a process of its own that reaches no other file, process or network; what holds it on "
      "this "
      "machine is tried and shown at the start.");
}

void add_trust(CLI::App& command, bool& trust) {
  command.add_flag("--trust", trust, "give the script the whole of Lua, and files anywhere");
}

// A terminal shows what scripts and files hold and obeys none of it. Standard output of a script is its own,
// and reaches a program or a file as it is; libedit, at the prompt, writes to the terminal by itself.
void make_streams_plain(int argc, char** argv) {
  const std::string_view command = argc > 1 ? argv[1] : "";
  const bool prints_of_script = command == "run" || command == "lesson" || command == "accuracy";
  cli::make_errors_plain();
  if (command == "repl" || (prints_of_script && ::isatty(STDOUT_FILENO) == 0)) return;
  cli::make_output_plain(prints_of_script ? cli::Keeps::colours : cli::Keeps::text);
}

void add_confinement(CLI::App& command, cli::RunCommand& run, std::string& limit_disk) {
  command.add_flag(
      "--confined", run.confined,
      "for a script of somebody else's: it reads its own folder, writes the run directory and reaches no "
      "other file, process or network, by barriers of the operating system; 10 min, half the machine's "
      "memory and 1 GiB on the disk unless told otherwise");
  command
      .add_option("--read", run.read,
                  "a folder that a confined script may read besides its own; may be given again")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command.add_option(
      "--without-barriers", run.without_barriers,
      "which barriers need not stand where the system cannot give them: files, processes, network, "
      "programs, with commas between");
  command.add_option("--limit-disk", limit_disk,
                     "most bytes in the directory of a confined run, e.g. 4G (default 1G)");
}

// What is of a confined run alone.
void check_confinement(const cli::RunCommand& run, bool confined) {
  if (confined) return;
  for (const auto& [option, given] : {std::pair("`--read`", !run.read.empty()),
                                      std::pair("`--without-barriers`", !run.without_barriers.empty()),
                                      std::pair("`--limit-disk`", run.limit_disk.has_value())})
    if (given)
      throw Error(ErrorCode::bad_value, std::string(option) + " is of a confined run, and this one is not",
                  "add --confined, or leave it out");
}

// What the parser has to say of a command line, in streams that are plain.
int parser_exit(const CLI::App& app, const CLI::Error& error) {
  std::ostringstream out, err;
  const int status = app.exit(error, out, err);
  std::fputs(out.str().c_str(), stdout);
  std::fputs(err.str().c_str(), stderr);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  // The child of `asperity serve`: nothing of the command line is for it.
  if (argc == 2 && std::string_view(argv[1]) == "--confined") return web::confined_main();

  make_streams_plain(argc, argv);

  CLI::App app{"Asperity: a laboratory for rough surfaces, scripted in Lua."};
  app.name("asperity");
  app.require_subcommand(1);
  app.set_help_flag("-h,--help", "show this help");
  app.set_version_flag("--version", "asperity " + lua::version_text());

  cli::RunCommand run, check, explain;
  cli::AccuracyCommand accuracy;
  cli::ReplayCommand replay;
  web::ServeCommand serve;
  std::string serve_time, serve_memory, run_disk, replay_disk;
  cli::LessonCommand lesson;
  std::string replay_time, replay_memory;
  cli::ReplCommand repl;
  std::string repl_time, repl_memory;
  std::string run_time, check_time, explain_time, accuracy_time, memory, accuracy_memory, store_limit, shard,
      at_most, truth, topic, lesson_memory;
  bool reference = false, types = false, manual = false, completion = false, explain_json = false;

  CLI::App& run_command = *app.add_subcommand("run", "run a script and keep what it finds");
  add_script_options(run_command, run, run_time)->required(false);
  add_run_options(run_command, run, memory);
  add_trust(run_command, run.trust);
  add_store_options(run_command, run, store_limit, shard);
  add_confinement(run_command, run, run_disk);

  CLI::App& replay_command = *app.add_subcommand(
      "replay",
      "run the script of a recorded run again, with its arguments and seed, and compare every result");
  replay_command.add_option("run", replay.recorded, "the directory of the run")->required();
  replay_command.add_option(
      "--from", replay.from,
      "take the results of heavy calls before this line of its journal from its store, and "
      "compute from there on");
  replay_command
      .add_option("--set", replay.settings,
                  "key=value or call.key=value: another value where calls give this key (from --from "
                  "on), e.g. --set press.pressure=\"200 MPa\"; may be given again")
      ->allow_extra_args(false);
  add_run_options(replay_command, replay.run, replay_memory);
  add_trust(replay_command, replay.run.trust);
  add_confinement(replay_command, replay.run, replay_disk);
  replay_command.add_option("--limit-time", replay_time, "end it after this long, e.g. 60s or \"2 min\"");
  replay_command.footer(
      "Every call, row, expectation and file is compared by its digest; times and dates are not. "
      "Of a run by an earlier version the laws that changed since are listed, and it is compared within "
      "them: "
      "numbers to 1e-05, digests of what has other last digits not at all. "
      "Exit status 1 where anything differs that no changed law explains. What the script prints is "
      "dropped.");

  CLI::App& accuracy_command = *app.add_subcommand(
      "accuracy",
      "what accuracy costs a script that returns a number: it is run again on coarser and finer grids (every "
      "`cells` times 1/4, 1/2, 1, 2, rounded) and with looser and tighter contacts, and each is timed");
  add_script_options(accuracy_command, accuracy.run, accuracy_time);
  add_run_options(accuracy_command, accuracy.run, accuracy_memory);
  add_trust(accuracy_command, accuracy.run.trust);
  accuracy_command.add_option("--at-most", at_most,
                              "time for all runs together (default 5 min); quoted first and kept");
  accuracy_command.add_option("--repeats", accuracy.repeats, "timed runs of each setting (default 3)")
      ->check(CLI::Range(1, 100000));
  accuracy_command.add_option(
      "--truth", truth,
      "the exact value, a number or a quantity such as \"0.1 um\"; without it the finest grid "
      "is taken for it");
  accuracy_command.footer(
      "The first run is the script as it is written: its output is shown and its files are kept. What the "
      "repeated "
      "runs print and write is dropped. The table goes to standard output, accuracy.csv and accuracy.svg to "
      "the run "
      "directory.");

  CLI::App& serve_command = *app.add_subcommand(
      "serve", "open the laboratory as a page: an editor, runs, charts and lessons in a browser");
  add_serve_options(serve_command, serve, serve_time, serve_memory);

  CLI::App& check_command = *app.add_subcommand("check", "look for mistakes in a script without running it");
  add_script_options(check_command, check, check_time);

  CLI::App& explain_command = *app.add_subcommand(
      "explain",
      "what a script will compute, and at what cost: its surfaces are made and its contacts planned, "
      "but nothing is pressed; a loop over a sweep turns once");
  add_script_options(explain_command, explain, explain_time);
  explain_command.add_flag("--json", explain_json, "as JSON");

  CLI::App& repl_command =
      *app.add_subcommand("repl", "try things line by line, each value shown as it comes");
  repl_command.add_option("--out", repl.out,
                          "the run directory (default runs/prompt-<n>); made when the first file is written");
  add_machine_options(repl_command, repl.threads, repl_memory);
  add_seed(repl_command, repl.seed);
  repl_command.add_option("--limit-time", repl_time, "end a line after this long, e.g. 60s or \"2 min\"");
  repl_command.add_flag("--no-history", repl.no_history,
                        "neither read nor keep the lines of other sessions, which are in "
                        "$XDG_STATE_HOME/asperity/history, or ~/.local/state");
  add_trust(repl_command, repl.trust);
  repl_command.footer(
      "help() explains, Tab completes, show(surface) draws. Ctrl-C stops a line and not the session, Ctrl-D "
      "ends it. From a pipe or a file the lines are read without prompts; exit status 1 where one failed.");
  CLI::App& lesson_command = *app.add_subcommand(
      "lesson", "lessons that come with the program: lists them, shows one, copies or runs it");
  lesson_command.add_option("name", lesson.name, "a lesson, by name or number; without it they are listed");
  CLI::Option* copied = lesson_command.add_flag("--copy", lesson.copy,
                                                "put its script into this folder, to be changed and run");
  lesson_command.add_flag("--run", lesson.run, "run it as it is")->excludes(copied);
  add_run_options(lesson_command, lesson.options, lesson_memory);

  CLI::App& help_command = *app.add_subcommand("help", "explain the language: a module, a function, a value");
  help_command.add_option("topic", topic, "e.g. lab.surface, sine, State.area");
  help_command.add_flag("--reference", reference, "the whole reference as Markdown");
  help_command.add_flag("--types", types, "the types of the language for editors (LuaCATS)");
  help_command.add_flag("--manual", manual, "this program's manual page");
  help_command.add_flag("--completion", completion, "what bash completes on its command line");

  CLI::App& materials_command = *app.add_subcommand("materials", "list the materials known by name");
  CLI::App& version_command = *app.add_subcommand("version", "show what this program is and was built with");

  // A word that is no command is answered with the nearest one, which the parser does not know how to do.
  if (argc > 1 && argv[1][0] != '-') {
    std::vector<std::string> commands;
    for (const CLI::App* command : app.get_subcommands({})) commands.push_back(command->get_name());
    if (std::find(commands.begin(), commands.end(), argv[1]) == commands.end()) {
      std::fprintf(stderr, "asperity: there is no command %s%s; the commands are %s\n",
                   quoted(argv[1]).c_str(), did_you_mean(argv[1], commands).c_str(),
                   joined(commands, " and ").c_str());
      return bad_usage;
    }
  }

  try {
    app.parse(argc, argv);
    auto seconds = [](const std::string& text) -> std::optional<double> {
      if (text.empty()) return {};
      try {
        const Quantity q = parse_quantity(text);
        if ((q.dimension == dimension::time || q.dimension == dimension::number) && q.value > 0)
          return q.value;
      } catch (const Error&) {
        // Whatever it is, it is no time.
      }
      throw Error(ErrorCode::bad_value, "a time limit is " + quoted(text),
                  "give a time such as 60s or \"2 min\"");
    };
    run.seed_given = run_command.count("--seed") > 0;
    run.limit_time = seconds(run_time);
    replay.run.limit_time = seconds(replay_time);
    serve.limit_time = seconds(serve_time);
    if (!serve_memory.empty()) serve.limit_memory = cli::parse_bytes(serve_memory);
    check.limit_time = seconds(check_time);
    explain.limit_time = seconds(explain_time);
    repl.limit_time = seconds(repl_time);
    accuracy.run.limit_time = seconds(accuracy_time);
    accuracy.at_most = seconds(at_most).value_or(accuracy.at_most);
    if (!truth.empty()) accuracy.truth = exact_value(truth);
    if (!memory.empty()) run.limit_memory = cli::parse_bytes(memory);
    if (store_limit == "0")
      run.store_limit = 0;
    else if (!store_limit.empty())
      run.store_limit = cli::parse_bytes(store_limit);
    if (!shard.empty()) run.shard = cli::parse_shard(shard);
    if (run.shard && run.store_limit == 0)
      throw Error(ErrorCode::bad_value, "`--shard` keeps its cases, and `--store-limit 0` keeps nothing",
                  "leave one of them out");
    if (run_command.parsed() && run.script.empty() && !run.resume)
      throw Error(ErrorCode::bad_value, "no script was named",
                  "give one, as in asperity run examples/quick_start.lua, or --resume RUN");
    if (!run_disk.empty()) run.limit_disk = cli::parse_bytes(run_disk);
    if (!replay_disk.empty()) replay.run.limit_disk = cli::parse_bytes(replay_disk);
    run.confined = run_command.parsed() && web::to_be_confined(run);
    replay.run.confined = replay_command.parsed() && web::to_be_confined(replay);
    check_confinement(run, run.confined);
    check_confinement(replay.run, replay.run.confined);
    if (!repl_memory.empty()) repl.limit_memory = cli::parse_bytes(repl_memory);
    if (!lesson_memory.empty()) lesson.options.limit_memory = cli::parse_bytes(lesson_memory);
    if (!replay_memory.empty()) replay.run.limit_memory = cli::parse_bytes(replay_memory);
    if (!accuracy_memory.empty()) accuracy.run.limit_memory = cli::parse_bytes(accuracy_memory);
  } catch (const CLI::Success& success) {
    return parser_exit(app, success);
  } catch (const CLI::ParseError& error) {
    parser_exit(app, error);
    return bad_usage;
  } catch (const Error& error) {
    std::fprintf(stderr, "asperity: %s\n", error.what());
    return bad_usage;
  }

  if (run_command.parsed()) return run.confined ? web::run_behind_barriers(run) : cli::run(run);
  if (replay_command.parsed())
    return replay.run.confined ? web::replay_behind_barriers(replay) : cli::replay(replay);
  if (serve_command.parsed()) return web::serve(serve);
  if (check_command.parsed()) return cli::check(check);
  if (explain_command.parsed()) return cli::explain(explain, explain_json);
  if (accuracy_command.parsed()) return cli::accuracy(accuracy);
  if (repl_command.parsed()) return cli::repl(repl);
  if (lesson_command.parsed()) return cli::lesson(lesson);
  if (help_command.parsed() && manual) {
    std::fputs(cli::manual_page(app, lua::version_text()).c_str(), stdout);
    return 0;
  }
  if (help_command.parsed() && completion) {
    std::vector<std::string> names;
    for (const lua::Lesson& known : lua::lessons()) names.push_back(known.name);
    std::fputs(cli::bash_completion(app, names).c_str(), stdout);
    return 0;
  }
  if (help_command.parsed()) return print_help(topic, reference, types);
  if (materials_command.parsed()) print_materials();
  if (version_command.parsed())
    for (const auto& [name, version] : lua::version_facts())
      std::printf("%-9s %s\n", name.c_str(), version.c_str());
  return 0;
}
