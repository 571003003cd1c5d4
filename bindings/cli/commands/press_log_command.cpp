// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity press-log`, with scripts/press_log.lua.
#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bindings/cli/commands/run_command.hpp"
#include "bindings/cli/commands/shared_options.hpp"
#include "bindings/lua/registry/embedded.hpp"

namespace asperity::cli {

namespace {

CommandReader declare_press_log(CLI::App& options) {
  struct Given {
    RunCommand run;
    std::vector<std::pair<std::string, std::string>> words{
        {"log", ""}, {"area", ""}, {"skip", ""}, {"columns", ""}, {"turn_step", ""}, {"specimen", ""}};
  };
  const auto given = std::make_shared<Given>();
  const auto word = [&](std::size_t k) -> std::string& { return given->words[k].second; };
  options.add_option("file", word(0), "the log: a table of samples or of events")->required();
  options.add_option(
      "--area", word(1),
      "area of the specimen that was pressed, e.g. \"490 mm^2\"; its loads become mean pressures");
  options.add_option("--skip", word(2), "lines above the titles of the columns (default: they are found)")
      ->type_name("WHOLE NUMBER");
  options.add_option("--columns", word(3),
                     "what columns are called in the file, e.g. load=Standardkraft,time=Prüfzeit");
  options.add_option("--turn-step", word(4), "turns are whole multiples of this, e.g. \"90 deg\"");
  options.add_option("--specimen", word(5),
                     "a Lua script that returns the contact to press, or a function that is given the "
                     "protocol and returns one (default: two rough discs of Al-2011)");
  add_seed(options, given->run.seed);
  add_seconds(options, "--limit-time", given->run.limit_time,
              "end the run after this long, e.g. 60s or \"2 min\"");
  add_run_options(options, given->run);
  options.add_option("arguments", given->run.arguments,
                     "keys of lab.protocol.read as name=value, and cells=; put them after --");
  return [given, &options]() -> CommandWork {
    RunCommand& run = given->run;
    run.seed_given = options.count("--seed") > 0;
    run.script = "press_log.lua";
    run.text = std::string(lua::embedded_script("press_log"));
    std::vector<std::string> arguments;
    for (const auto& [name, value] : given->words)
      if (!value.empty()) arguments.push_back(name + "=" + value);
    run.arguments.insert(run.arguments.begin(), arguments.begin(), arguments.end());
    return [given] { return cli::run(given->run); };
  };
}

}  // namespace

Command press_log_command() {
  return {
      .name = "press-log",
      .sentence =
          "find the events in a log of a press, draw them, and replay them on two rough bodies as a run "
          "that is recorded",
      .overview =
          "asperity press-log FILE                        find, draw and replay the events of a press log\n",
      .prints = Prints::of_script,
      .declare = declare_press_log};
}

}  // namespace asperity::cli
