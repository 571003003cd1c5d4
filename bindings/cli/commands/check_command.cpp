// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity check`, `asperity explain` and `asperity cases`: a script without its heavy calls.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/cli/commands/run_command.hpp"
#include "bindings/cli/commands/shared_options.hpp"
#include "bindings/cli/terminal_monitor.hpp"
#include "bindings/cli/watchdog.hpp"
#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/dry_run.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "bindings/lua/specimen/explanation.hpp"
#include "engine/core/files/json.hpp"
#include "engine/core/text.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::cli {

namespace {

// From a traceback; the error itself may come from a module.
std::string line_in_script(const std::string& message, const std::string& script) {
  // As Lua shortens chunk names.
  const std::string name =
      script.size() < LUA_IDSIZE ? script : "..." + script.substr(script.size() - (LUA_IDSIZE - 4));
  const std::string lead = "\n\t" + name + ":";
  const std::size_t at = message.find(lead);
  return lua::line_of(at == std::string::npos ? message : message.substr(at + lead.size() - 1));
}

// Reports mistakes and the reason of an early end. Returns the exit status.
int report_mistakes(const RunCommand& command, const std::vector<std::string>& mistakes,
                    const std::string& reached) {
  if (command.observer != nullptr) {
    for (std::size_t k = 0; k + 1 < mistakes.size(); ++k) command.observer->mistake(mistakes[k]);
    command.observer->ended(failed, StopReason::none, mistakes.back());
    return failed;
  }
  for (const std::string& mistake : mistakes)
    std::fprintf(stderr, "asperity: %s\n", (command.trace ? mistake : without_calls(mistake)).c_str());
  if (!reached.empty()) std::fprintf(stderr, "%s: checked %s\n", command.script.c_str(), reached.c_str());
  return failed;
}

int report_stop(const RunCommand& command, const std::string& verb) {
  const StopReason reason = stop_flag().reason();
  if (command.observer != nullptr) {
    command.observer->ended(failed, reason, "the " + verb + " was stopped");
    return failed;
  }
  std::fprintf(stderr, "asperity: %s: the %s was stopped\n", command.script.c_str(), verb.c_str());
  return exit_status(reason);
}

constexpr int most_charts = 100;  // for an observer

// `report` prints the findings; `reached`: reason of an early end, or "".
int dry_run(const RunCommand& command, const std::string& verb, lua::Session& session,
            const std::function<void(const std::string& reached)>& report) {
  const std::string text = command.text ? *command.text : read_script(command.script);
  RunObserver* const observer = command.observer;
  std::optional<double> limit = command.limit_time;
  if (!limit && Watchdog::has_clock) limit = 60;
  Watchdog watchdog(limit, [&](StopReason reason) {
    if (observer != nullptr)
      return observer->ended(failed, reason, "the " + verb + " did not come to an end");
    std::fprintf(stderr, "asperity: %s: the %s did not come to an end\n", command.script.c_str(),
                 verb.c_str());
  });
  session.dry_run = true;
  session.mistakes = std::make_shared<lua::Mistakes>();
  session.mistakes->script = text;
  const auto end = [&](const std::string& reached, const std::string& failure) {
    if (observer != nullptr)
      observer->made_knobs(session.knobs->json());
    else
      for (const std::string& note : session.mistakes->notes())
        std::fprintf(stderr, "asperity: note: %s\n", note.c_str());
    std::vector<std::string> mistakes = session.mistakes->messages();
    if (mistakes.empty() && failure.empty()) return report(reached), done;
    if (!failure.empty()) mistakes.push_back(failure);
    return report_mistakes(command, mistakes, reached);
  };
  session.run = std::make_shared<RunDirectory>(RunDirectory::Without::dry);
  if (observer != nullptr)
    session.run->journal().watch([observer, left = most_charts](auto event, const Json& fields) mutable {
      if (event == "chart" && left-- > 0) observer->recorded(event, fields);
    });
  session.exit_hook = [&](int) {
    const int status = end("to its os.exit", "");
    std::fflush(nullptr);
    std::_Exit(status);
  };
  try {
    RunCommand unlimited = command;  // dry runs limit themselves
    unlimited.limit_time.reset();
    const lua::State state = make_state(session, unlimited);
    const Watchdog::Watching watching(watchdog, state.get());
    const int result = execute(state.get(), command, text, 0);
    if (result == LUA_OK) return end("", unmade_knobs(session));
    const std::string message = lua::error_text(state.get(), -1);
    if (stop_flag().reason() != StopReason::none) return report_stop(command, verb);
    if (lua::stopped_at_placeholder(message))
      return end("to line " + line_in_script(message, command.script) + ": " + lua::cannot_follow, "");
    // A result would set this value in a real run, unless the script forgot it.
    if (session.gave_placeholders && lua::met_nothing(message))
      return end("to line " + line_in_script(message, command.script) + ", " + lua::without_place(message) +
                     ": a mistake, unless a result of the run sets it",
                 "");
    return end("", message);
  } catch (const std::exception& error) {
    if (observer != nullptr)
      observer->ended(failed, StopReason::none, error.what());
    else
      std::fprintf(stderr, "asperity: %s\n", error.what());
  }
  return failed;
}

// Computations and their cost, without presses. Exit status as in run().
int explain(const RunCommand& command, bool json) {
  TerminalMonitor monitor;
  lua::Session session(monitor);
  session.explanation = std::make_shared<lua::Explanation>();
  session.on_call_left_out = [&](const lua::Call& call, const lua::Function& function) {
    note_call(*session.explanation, call, function);
  };
  return dry_run(command, "explanation", session, [&](const std::string& reached) {
    monitor.clear();
    if (json) {
      Json all = session.explanation->json();
      all.set("reached", reached.empty() ? "the end" : reached);
      std::printf("%s\n", all.text(2).c_str());
      return;
    }
    std::fputs(session.explanation->text().c_str(), stdout);
    if (!reached.empty()) std::printf("explained %s\n", reached.c_str());
  });
}

// Numbered as for --case of `asperity run`.
int cases(const RunCommand& command, bool list) {
  TerminalMonitor monitor;
  lua::Session session(monitor);
  session.on_ensemble = [&](const std::string& place, std::size_t count,
                            const std::function<std::string(std::size_t)>& name) {
    const int ensemble = session.numbered_ensembles;
    if (!list) std::printf("ensemble %d, %s: %s\n", ensemble, place.c_str(), counted(count, "case").c_str());
    const std::string before = ensemble == 1 ? "" : std::to_string(ensemble) + ".";
    for (std::size_t k = 0; list && k < count; ++k)
      std::printf("%s%zu\t%s\n", before.c_str(), k + 1, name(k).c_str());
  };
  return dry_run(command, "list of cases", session, [&](const std::string& reached) {
    if (!reached.empty()) std::fprintf(stderr, "%s: listed %s\n", command.script.c_str(), reached.c_str());
  });
}

enum class Follows { check, explain, cases };

struct FollowedScript {
  RunCommand run;
  bool json = false;  // for `explain`
  bool list = false;  // for `cases`
};

CommandReader declare(CLI::App& options, Follows follows) {
  const auto given = std::make_shared<FollowedScript>();
  add_script_options(options, given->run);
  add_knobs(options, given->run.knobs);
  options.add_flag("--trace", given->run.trace, "print the calls that led to an error");
  if (follows == Follows::explain) options.add_flag("--json", given->json, "as JSON");
  if (follows == Follows::cases)
    options.add_flag("--list", given->list, "a line for each case: its number, a tab, and its values");
  return [given, follows]() -> CommandWork {
    return [given, follows] {
      return follows == Follows::explain ? explain(given->run, given->json)
             : follows == Follows::cases ? cases(given->run, given->list)
                                         : cli::check(given->run);
    };
  };
}

}  // namespace

Command check_command() {
  return {.name = "check",
          .sentence = "look for mistakes in a script without running it",
          .overview = "asperity check SCRIPT                          look for mistakes without running it\n",
          .declare = [](CLI::App& options) { return declare(options, Follows::check); }};
}

Command explain_command() {
  return {
      .name = "explain",
      .sentence =
          "what a script will compute, and at what cost: its surfaces are made and its contacts planned, "
          "but nothing is pressed; a loop over a sweep turns once",
      .overview = "asperity explain SCRIPT                        what it will compute, and at what cost\n",
      .declare = [](CLI::App& options) { return declare(options, Follows::explain); }};
}

Command cases_command() {
  return {
      .name = "cases",
      .sentence =
          "the cases of a script's ensembles, found without running it; an ensemble whose values "
          "depend on results is listed as far as they are known",
      .overview = "asperity cases SCRIPT --list                   the cases of its ensembles, by number\n",
      .declare = [](CLI::App& options) { return declare(options, Follows::cases); }};
}

int check(const RunCommand& command) {
  TerminalMonitor monitor;
  lua::Session session(monitor);
  return dry_run(command, "check", session, [&](const std::string& reached) {
    if (command.observer != nullptr) return command.observer->ended(done, StopReason::none, reached);
    std::printf("%s: no problem found%s%s\n", command.script.c_str(), reached.empty() ? "" : "; checked ",
                reached.c_str());
  });
}

}  // namespace asperity::cli
