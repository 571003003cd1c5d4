// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/cli/commands/run_command.hpp"

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "bindings/cli/commands/shared_options.hpp"
#include "bindings/cli/commands/stored_results.hpp"
#include "bindings/cli/exit_status.hpp"
#include "bindings/cli/mpi_ranks.hpp"
#include "bindings/cli/run_observer.hpp"
#include "bindings/cli/shard.hpp"
#include "bindings/cli/terminal_monitor.hpp"
#include "bindings/cli/unlinked_files.hpp"
#include "bindings/cli/watchdog.hpp"
#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "bindings/lua/runtime/version.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/core/files/temporary_folder.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/sanitizers.hpp"
#include "engine/core/text.hpp"
#include "engine/run/result_files.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::cli {

namespace {

// Uncounted memory (a library's heap) still ends in bad_alloc.
void limit_address_space(std::int64_t bytes) {
  if (sanitized) return;
  constexpr std::int64_t headroom = std::int64_t{512} << 20;  // code, stacks, libraries
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, static_cast<rlim_t>(bytes + headroom));
  setrlimit(RLIMIT_DATA, &limit);
}

// Charts need descriptors for fonts. No warning of the run, because it depends on the machine.
void tell_of_few_handles() {
  constexpr rlim_t enough = 32;
  rlimit handles{};
  if (::getrlimit(RLIMIT_NOFILE, &handles) == 0 && handles.rlim_cur < enough)
    std::fprintf(stderr,
                 "asperity: only %d files may be open at once, so pictures by gnuplot may lack their fonts; "
                 "allow more with `ulimit -n`\n",
                 static_cast<int>(handles.rlim_cur));
}

// "" if complete or if the reader closed the pipe.
std::string output_fault() {
  const bool lost = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  struct ::stat facts {};
  if (!lost || ::fstat(STDOUT_FILENO, &facts) != 0 || S_ISFIFO(facts.st_mode) || S_ISSOCK(facts.st_mode))
    return {};
  return "standard output could not be written to its end, so what the script printed is not all there; "
         "check "
         "the disk";
}

std::string reason_text(StopReason reason, const RunCommand& command) {
  switch (reason) {
    case StopReason::interrupt:
      return "interrupted";
    case StopReason::time_limit:
      return "the time limit of " + format_quantity(command.limit_time.value_or(0), dimension::time) +
             " was reached";
    case StopReason::memory_limit:
      return "the memory limit of " +
             format_short(static_cast<double>(command.limit_memory.value_or(0)) / 0x1p20) +
             " MiB was reached (--limit-memory)";
    case StopReason::none:
      break;
  }
  return "";
}

void add_store_options(CLI::App& options, RunCommand& run, std::string& limit, std::string& shard,
                       std::string& one_case) {
  CLI::Option* resume =
      options.add_option("--resume", run.resume,
                         "go on with the run in this directory where it was cut off; its script, arguments "
                         "and seed are its own (a directory that is not there yet is begun)");
  resume->excludes(options.get_option("--out"));
  options
      .add_option("--reuse", run.reuse,
                  "take the results of heavy calls that are the same from this run; may be given again")
      ->allow_extra_args(false);  // the next word may be the script
  options.add_option("--store-limit", limit,
                     "most bytes of results to keep for this, e.g. 20G (default 8G); 0 keeps none");
  options.add_option(
      "--store", run.store,
      "keep results in this folder and find them there, instead of RUN/store; several runs, on several "
      "machines, may share it at the same time (no limit unless --store-limit is given)");
  CLI::Option* share = options.add_option(
      "--shard", shard,
      "i/n: compute the cases i, i+n, i+2n, ... of every ensemble and keep them in the folder given by "
      "--store; slurm: i and n are those of this task of a job array. The script goes on past an "
      "ensemble once all its cases are there, and else ends. A run without --shard puts all together");
  CLI::Option* one = options.add_option(
      "--case", one_case,
      "compute case 17, or case 17 of the second ensemble (2.17), into the folder given by "
      "--store, and leave no run directory. Exit status: 0 it is stored, 1 it failed, 3 "
      "cases of an earlier ensemble are missing. `asperity cases` lists the numbers");
  CLI::Option* merge =
      options.add_flag("--merge-only", run.merge_only,
                       "compute no case: take all from the folder given by --store, or end with exit "
                       "status 3 and the list of the missing cases");
  for (CLI::Option* option : {share, one, merge})
    option->needs(options.get_option("--store"))->excludes(options.get_option("--trust"));
  for (CLI::Option* other :
       {share, merge, resume, options.get_option("--out"), options.get_option("--reuse")})
    one->excludes(other);
  merge->excludes(share);
}

CaseNumber case_number(const std::string& text) {
  CaseNumber one;
  const std::size_t dot = text.find('.');
  const auto read = [&](std::string_view part, auto& value) {
    const auto [end, problem] = std::from_chars(part.data(), part.data() + part.size(), value);
    return problem == std::errc() && end == part.data() + part.size() && value >= 1;
  };
  const std::string_view all(text);
  if ((dot == std::string::npos || read(all.substr(0, dot), one.ensemble)) &&
      read(dot == std::string::npos ? all : all.substr(dot + 1), one.number))
    return one;
  throw Error(ErrorCode::bad_value, "`--case` is " + quoted(text),
              "give the number of a case, such as 17, or 2.17 for the second ensemble");
}

CommandReader declare_run(CLI::App& options, BehindBarriers<RunCommand> barriers) {
  struct Given {
    RunCommand run;
    std::string time, memory, store_limit, shard, one_case, disk;
    std::vector<std::string> knobs;
  };
  const auto given = std::make_shared<Given>();
  add_script_options(options, given->run, given->time)->required(false);
  add_run_options(options, given->run, given->memory);
  add_knobs(options, given->knobs);
  add_trust(options, given->run.trust);
  add_store_options(options, given->run, given->store_limit, given->shard, given->one_case);
  add_confinement(options, given->run, given->disk);

  return [given, &options, barriers]() -> CommandWork {
    RunCommand& run = given->run;
    run.seed_given = options.count("--seed") > 0;
    run.limit_time = seconds_of(given->time);
    run.limit_memory = bytes_of(given->memory);
    run.knobs = knobs_of(given->knobs);
    run.store_limit = given->store_limit == "0" ? 0 : bytes_of(given->store_limit, "the limit of the store");
    if (!given->shard.empty()) run.shard = parse_shard(given->shard);
    if (!given->one_case.empty()) run.one_case = case_number(given->one_case);
    if ((run.shard || run.one_case || run.merge_only) && run.store_limit == 0)
      throw Error(ErrorCode::bad_value,
                  "`--shard`, `--case` and `--merge-only` share a store, and `--store-limit 0` keeps nothing",
                  "leave one of them out");
    if (run.script.empty() && !run.resume)
      throw Error(ErrorCode::bad_value, "no script was named",
                  "give one, as in asperity run examples/quick_start.lua, or --resume RUN");
    run.limit_disk = bytes_of(given->disk, "the limit of the disk");
    run.confined = barriers.wanted(run);
    check_confinement(run);
    if (run.confined && (run.one_case || run.merge_only))
      throw Error(ErrorCode::bad_value, "a confined run takes neither `--case` nor `--merge-only`",
                  "share its cases by --shard, and merge them by a run without it");
    return [given, barriers] {
      return given->run.confined ? barriers.carry_out(given->run) : cli::run(given->run);
    };
  };
}

// With --case, only the store keeps a result.
void remove_case_folder(const RunCommand& command) {
  if (command.case_folder) command.case_folder->remove();
}

}  // namespace

Command run_command(BehindBarriers<RunCommand> barriers) {
  return {.name = "run",
          .sentence = "run a script and keep what it finds",
          .overview =
              "asperity run SCRIPT [options] [-- arguments]   run a script and keep what it finds\n"
              "asperity run --resume RUN                      go on with a run that was cut off\n",
          .prints = Prints::of_script,
          .declare = [barriers](CLI::App& options) { return declare_run(options, barriers); }};
}

Json version_json() {
  Json versions = Json::object();
  for (const auto& [name, version] : lua::version_facts()) versions.set(name, version);
  return versions;
}

void limit_memory(std::int64_t bytes) {
  memory::set_limit(bytes);
  limit_address_space(bytes);
}

std::string read_script(const std::string& path) {
  std::error_code problem;
  if (std::filesystem::is_directory(path, problem))
    throw Error(ErrorCode::bad_file, quoted(path) + " is a folder", "give the path of a Lua script");
  if (::access(path.c_str(), R_OK) != 0)
    throw Error(ErrorCode::bad_file, "there is no script " + quoted(path) + " that can be read");
  return text_of_file(path);
}

int execute(lua_State* L, const RunCommand& command, const std::string& text, int results) {
  bool failed_inside = false;
  const std::vector<std::string>& arguments = command.arguments;
  auto action = [&](lua_State* state) -> int {
    failed_inside = true;
    lua_pushcfunction(state, lua::traceback_handler);
    const std::string& name = command.script;
    lua_pushfstring(state, "@%s", name.c_str());
    const std::size_t skip = lua::begin_of_script(text);
    if (skip < text.size() && text[skip] == LUA_SIGNATURE[0]) {
      lua_pushfstring(state, "%s: attempt to load a binary chunk: a script is text, and this is compiled Lua",
                      name.c_str());
      return 1;
    }
    // Without trailing blanks, Lua reports an unfinished statement at the last line with text.
    const std::size_t end = std::max(skip, text.find_last_not_of(" \t\r\n") + 1);
    if (luaL_loadbufferx(state, text.data() + skip, end - skip, lua_tostring(state, -1), "t") != LUA_OK)
      return 1;
    lua_remove(state, -2);
    lua_createtable(state, static_cast<int>(arguments.size()), 1);
    lua_pushstring(state, name.c_str());
    lua_rawseti(state, -2, 0);
    for (std::size_t k = 0; k < arguments.size(); ++k) {
      lua_pushlstring(state, arguments[k].data(), arguments[k].size());
      lua_rawseti(state, -2, static_cast<lua_Integer>(k) + 1);
    }
    lua_setglobal(state, "arg");
    luaL_checkstack(state, static_cast<int>(arguments.size()) + 4, "too many arguments");
    for (const std::string& argument : arguments) lua_pushlstring(state, argument.data(), argument.size());
    if (lua_pcall(state, static_cast<int>(arguments.size()), results, 1) != LUA_OK) return 1;
    failed_inside = false;
    return results;
  };
  const int status = lua::protect(L, 0, LUA_MULTRET, action);
  return status != LUA_OK || failed_inside ? LUA_ERRRUN : LUA_OK;
}

lua::State make_state(lua::Session& session, const RunCommand& command) {
  session.seed = command.seed;
  session.trusted = command.trust;
  session.knobs = std::make_shared<RunKnobs>(command.knobs);
  const std::string folder = std::filesystem::path(command.script).parent_path().string();
  session.script = {command.script, folder.empty() ? "." : folder};
  lua::State state = lua::make_state(session, session.script.folder);
  if (command.limit_time || command.limit_memory) lua::watch_for_stops(state.get());
  return state;
}

int in_run_directory(const RunCommand& command, const std::function<std::string(RunContext&)>& work) {
  std::string text;
  std::shared_ptr<RunDirectory> run;
  ResultFilesSetup kept;
  set_thread_count(command.threads);
  try {
    text = command.text ? *command.text : read_script(command.script);
    RunSetup setup;
    setup.script_name = command.script;
    setup.script_text = text;
    if (command.out) setup.out = *command.out;
    if (command.resume) setup.resume = *command.resume;
    setup.anew = command.anew;
    setup.journal_lost = command.journal_lost;
    setup.lock = command.lock;
    // Files of other ranks than 0 are deleted at the end.
    setup.scratch = command.one_case || (command.ranks != nullptr && !command.ranks->leads());
    setup.store = command.store.value_or("");
    if (command.shard) setup.shard = command.shard->text();
    setup.trusted = command.trust;
    setup.barriers = command.barriers;
    setup.arguments = command.arguments;
    setup.seed = static_cast<std::int64_t>(command.seed);
    setup.threads = thread_count();
    if (!command.knobs.empty()) setup.knobs = given_knobs_json(command.knobs);
    setup.versions = version_json();
    kept = result_files(command);
    run = std::make_shared<RunDirectory>(setup);
    if (!command.store) kept.folder = run->store();
    // Now, because the moving aside of an earlier run may have moved this folder, too.
    if (command.store) make_folders(*command.store);
    kept.needed = run->needed_to_resume();
  } catch (const Error& error) {
    std::fprintf(stderr, "asperity: %s\n", error.what());
    return bad_usage;
  }

  if (const std::string notice = run->lock_notice(); !notice.empty() && command.observer == nullptr)
    std::fprintf(stderr, "asperity: %s\n", notice.c_str());
  for (const std::string& damage : command.damages)
    std::fprintf(stderr, "asperity: %s; the run is made again from its script and its store\n",
                 damage.c_str());

  if (command.observer == nullptr) tell_of_few_handles();
  TerminalMonitor monitor;
  monitor.keep_warnings_in(run.get());
  monitor.count_alike();
  if (command.terminal) monitor.show_as_on_terminal();
  ResultFiles results(std::move(kept));
  run->before_its_end([&results] { results.bring_to_disk(); });
  UntilLine until(results, run->journal(), command.afresh_from.value_or(0));
  ResultStore* store = command.afresh_from ? static_cast<ResultStore*>(&until) : &results;
  if (command.store_limit == 0) store = nullptr;
  std::optional<RankStore> of_ranks;
  if (command.ranks != nullptr) {
    // Temporary folders of other ranks would lose results.
    command.ranks->own_store = command.ranks->leads() || command.store ? store : nullptr;
    store = &of_ranks.emplace(*command.ranks);
  }
  monitor.keep_results_in(store);
  RunObserver* const observer = command.observer;
  if (observer != nullptr) {
    monitor.report_to(observer);
    run->journal().watch(
        [observer](std::string_view event, const Json& fields) { observer->recorded(event, fields); });
  }
  const auto summary = [&] {
    monitor.tell_alike();
    if (observer != nullptr) return;
    const ResultFiles::Counts counts = results.counts();
    const std::string verdicts = run->expectations().summary();
    monitor.clear();
    if (!verdicts.empty()) std::fprintf(stderr, "%s\n", verdicts.c_str());
    for (const Verdict& verdict : run->expectations().verdicts())
      if (!verdict.passed) std::fprintf(stderr, "  failed: %s\n", verdict.sentence.c_str());
    const std::string saved =
        counts.seconds_saved < 1
            ? ""
            : ", which had cost " + format_quantity(counts.seconds_saved, dimension::time, 3);
    if (counts.found > 0)
      std::fprintf(stderr, "%lld %s taken from the store%s\n", static_cast<long long>(counts.found),
                   counts.found == 1 ? "result was" : "results were", saved.c_str());
    for (const std::string& notice : results.notices()) std::fprintf(stderr, "%s\n", notice.c_str());
    if (const std::string departure = run->journal().departure(); !departure.empty())
      std::fprintf(stderr, "%s\n", departure.c_str());
    if (run->mended()) std::fprintf(stderr, "every file is again as it was recorded\n");
    if (!command.one_case) std::fprintf(stderr, "results in %s\n", run->path().c_str());
  };
  Watchdog watchdog(command.limit_time, [&](StopReason reason) {
    const std::string why = reason_text(reason, command);
    try {
      run->finish(reason == StopReason::interrupt ? RunStatus::interrupted : RunStatus::killed, why,
                  std::chrono::milliseconds(500));
    } catch (const std::exception& error) {
      std::fprintf(stderr, "asperity: %s\n", error.what());
    }
    if (observer != nullptr)
      observer->ended(exit_status(reason), reason, why);
    else
      std::fprintf(stderr, "asperity: %s; what was finished is in %s\n", why.c_str(), run->path().c_str());
    remove_case_folder(command);
  });

  std::optional<UnlinkedFilesBound> unlinked;
  if (command.limit_disk) unlinked.emplace(*command.limit_disk);

  if (command.limit_memory) limit_memory(*command.limit_memory);

  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe must not lose the record
  std::signal(SIGXFSZ, SIG_IGN);  // writing then fails as on a full disk

  int status = done;
  std::string why;
  RunContext context{command, text, run, monitor, watchdog, results, summary};
  try {
    why = work(context);
    if (!why.empty()) status = failed;
  } catch (const std::exception& error) {
    status = failed;
    why = error.what();
  }

  RunStatus ended = status == done ? RunStatus::done : RunStatus::failed;
  // The limit was exceeded, even if the script caught the error.
  if (command.limit_memory && lua::memory_limit_met()) {
    stop_flag().raise(StopReason::memory_limit);
    if (status == done) why = "the script went on with less";
    status = failed;
  }
  const StopReason stopped = status == done ? StopReason::none : stop_flag().reason();
  if (stopped != StopReason::none) {
    status = exit_status(stopped);
    ended = stopped == StopReason::interrupt ? RunStatus::interrupted : RunStatus::failed;
    // The position matters for a limit, not for Ctrl-C.
    const std::string met_at = stopped == StopReason::interrupt || why.empty() ? "" : "\n" + why;
    why = reason_text(stopped, command) + met_at;
  }
  monitor.clear();
  if (const std::string fault = output_fault(); status == done && !fault.empty()) {
    status = failed;
    ended = RunStatus::failed;
    why = fault;
  }
  if (!why.empty() && observer == nullptr) std::fprintf(stderr, "asperity: %s\n", why.c_str());
  if (command.ranks != nullptr) command.ranks->note_failure(why);
  try {
    if (status == done && run->expectations().failed() > 0) {
      status = failed;
      ended = RunStatus::failed;
      why = run->expectations().summary();
    }
    run->finish(ended, why);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "asperity: %s\n", error.what());
    if (status == done) status = failed;
  }
  summary();
  if (observer != nullptr) observer->ended(status, stopped, why);
  return status;
}

std::string unmade_knobs(const lua::Session& session) {
  try {
    session.knobs->check_all_made();
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

std::string run_script(RunContext& context, const std::function<int(int)>& at_exit) {
  lua::Session session(context.monitor);
  session.run = context.run;
  session.variation = context.command.variation;
  session.loaded = context.command.loaded;
  Digester script;
  script.add(context.text);
  for (const std::string& argument : context.command.arguments) script.add(argument);
  if (!context.command.knobs.empty()) script.add("knobs").add(RunKnobs(context.command.knobs).given_text());
  session.script_digest = script.hex();
  lua::SharedStore shared;
  if (context.command.store) {
    shared = {*context.command.store,
              context.command.shard,
              context.command.one_case,
              context.command.merge_only,
              [&results = context.results](std::int64_t bytes) { return results.takes(bytes); },
              {},
              {}};
    session.shared = &shared;
  }
  if (RunObserver* observer = context.command.observer; observer != nullptr && observer->looks_at_results())
    session.onlooker = [observer, run = context.run.get()](const std::string& call,
                                                           const lua::Values& results) {
      observer->found(call, run->journal().count(), results);
    };
  session.ranks = context.command.ranks;
  shared.tell = [&](const std::string& sentence) {
    context.monitor.clear();
    if (context.command.observer == nullptr) std::fprintf(stderr, "%s\n", sentence.c_str());
  };
  shared.end = [&](lua::SharedEnd end, const std::string& sentence) {
    using lua::SharedEnd;
    shared.tell(sentence);
    context.run->finish(context.command.merge_only ? RunStatus::failed : RunStatus::shard, sentence);
    context.summary();
    remove_case_folder(context.command);
    std::fflush(nullptr);
    std::_Exit(end == SharedEnd::stored    ? done
               : end == SharedEnd::failed  ? failed
               : end == SharedEnd::missing ? cases_missing
                                           : bad_usage);
  };
  session.exit_hook = [&](int code) {
    std::string unmade = code == 0 ? unmade_knobs(session) : "";
    if (code == 0 && unmade.empty()) unmade = output_fault();
    if (!unmade.empty() && context.command.observer == nullptr)
      std::fprintf(stderr, "asperity: %s\n", unmade.c_str());
    if (!unmade.empty() || (code == 0 && context.run->expectations().failed() > 0)) code = failed;
    const std::string why = unmade.empty() ? "os.exit(" + std::to_string(code) + ")" : unmade;
    context.run->finish(code == 0 ? RunStatus::done : RunStatus::failed, why);
    context.summary();
    if (context.command.observer != nullptr) context.command.observer->ended(code, StopReason::none, why);
    code = at_exit(code);
    if (context.command.ranks != nullptr) code = context.command.ranks->leave(code);
    std::fflush(nullptr);
    std::_Exit(code);
  };
  const lua::State state = make_state(session, context.command);
  const Watchdog::Watching watching(context.watchdog, state.get());
  if (execute(state.get(), context.command, context.text, 0) == LUA_OK) return unmade_knobs(session);
  return lua::placed_memory_error(lua::error_text(state.get(), -1));
}

int run(const RunCommand& asked) {
  RunCommand command = asked;
  const bool shares = asked.shard || asked.one_case || asked.merge_only;
  std::optional<LaunchedRank> launched;
  try {
    launched = launched_rank(shares);
    if (asked.one_case && !launched) {
      command.case_folder = std::make_shared<const TemporaryFolder>("case");
      command.out = (command.case_folder->path() / "run").string();
    }
  } catch (const Error& error) {
    std::fprintf(stderr, "asperity: %s\n", error.what());
    return bad_usage;
  }
  if (asked.resume) {
    try {
      std::optional<RunCommand> again = taken_up(asked, !launched || launched->rank == 0);
      if (!again) {
        std::fprintf(stderr,
                     "asperity: %s came to its end, and every file is as it was recorded; there is nothing "
                     "to resume\n",
                     asked.resume->c_str());
        const std::vector<std::string> altered = altered_inputs(read_run(*asked.resume, true));
        for (const std::string& sentence : altered) std::fprintf(stderr, "%s\n", sentence.c_str());
        if (!altered.empty())
          std::fprintf(stderr, "`asperity replay %s` says what follows from that\n", asked.resume->c_str());
        return done;
      }
      command = *std::move(again);
    } catch (const Error& error) {
      std::fprintf(stderr, "asperity: %s\n", error.what());
      return bad_usage;
    }
  }
  const auto leave = [&command](int code) {
    remove_case_folder(command);
    if (!command.one_case || code != done) return code;
    std::fprintf(stderr,
                 "asperity: %s came to its end and has no case %d.%zu; `asperity cases` lists its cases\n",
                 command.script.c_str(), command.one_case->ensemble, command.one_case->number);
    return bad_usage;
  };
  const auto work = [&leave](RunContext& context) { return run_script(context, leave); };
  if (!launched) return leave(in_run_directory(command, work));

  std::unique_ptr<MpiRanks> ranks;
  try {
    if (command.shard || shares)
      throw Error(ErrorCode::bad_value,
                  "`--shard`, `--case` or `--merge-only` was given to one of the ranks of mpirun",
                  "use one of the two: mpirun spreads the cases itself");
    if (command.threads == 0) command.threads = threads_of(*launched);
    ranks = std::make_unique<MpiRanks>(launched->size);
  } catch (const Error& error) {
    if (launched->rank == 0)
      std::fprintf(stderr, "asperity: started as %d ranks: %s\n", launched->size, error.what());
    return bad_usage;
  }
  command.ranks = ranks.get();
  if (!ranks->leads()) {
    command.out = ranks->scratch_folder();
    if (command.resume && !command.text) command.text = read_script(command.script);
    command.resume.reset();
    command.damages.clear();
    command.reuse.clear();
    command.anew = false;
    command.limit_time.reset();  // rank 0 watches
  }
  return ranks->leave(in_run_directory(command, work));
}

}  // namespace asperity::cli
