// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/cli/commands/run_command.hpp"

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "bindings/cli/commands/stored_results.hpp"
#include "bindings/cli/disk_bound.hpp"
#include "bindings/cli/mpi_ranks.hpp"
#include "bindings/cli/terminal_monitor.hpp"
#include "bindings/cli/watchdog.hpp"
#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/runtime/state_heap.hpp"
#include "bindings/lua/runtime/version.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/require.hpp"
#include "engine/plot/gnuplot.hpp"
#include "engine/run/result_files.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::cli {

namespace {

// Charts need descriptors for fonts. Not a warning of the run: it depends on the machine.
void tell_of_few_handles() {
  constexpr rlim_t enough = 32;
  rlimit handles{};
  if (::getrlimit(RLIMIT_NOFILE, &handles) == 0 && handles.rlim_cur < enough)
    std::fprintf(stderr,
                 "asperity: only %d files may be open at once, so pictures by gnuplot may lack their fonts; "
                 "allow more with `ulimit -n`\n",
                 static_cast<int>(handles.rlim_cur));
}

// "" also if the reader closed the pipe.
std::string output_fault() {
  const bool lost = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  struct ::stat facts {};
  if (!lost || ::fstat(STDOUT_FILENO, &facts) != 0 || S_ISFIFO(facts.st_mode) || S_ISSOCK(facts.st_mode))
    return {};
  return "standard output could not be written to its end, so printed lines are missing; check the disk";
}

std::string reason_text(StopReason reason, const RunCommand& command) {
  if (reason == StopReason::interrupt) return "interrupted";
  if (reason == StopReason::time_limit)
    return "the time limit of " + format_quantity(command.limit_time.value_or(0), dimension::time) +
           " was reached";
  if (reason == StopReason::memory_limit)
    return "the memory limit of " +
           format_short(static_cast<double>(command.limit_memory.value_or(0)) / 0x1p20) +
           " MiB was reached (--limit-memory)";
  return "";
}

CommandReader declare_run(CLI::App& options, BehindBarriers<RunCommand> barriers) {
  const auto given = std::make_shared<RunCommand>();
  add_script_options(options, *given)->required(false);
  add_run_options(options, *given);
  add_knobs(options, given->knobs);
  add_trust(options, given->trust);
  add_store_options(options, *given);
  add_confinement(options, *given);

  return [given, &options, barriers]() -> CommandWork {
    RunCommand& run = *given;
    run.seed_given = options.count("--seed") > 0;
    if ((run.shard || run.one_case || run.merge_only) && run.store_limit == 0)
      refuse("`--shard`, `--case` and `--merge-only` need a store, and `--store-limit 0` stores nothing",
             "leave one of them out");
    if (run.script.empty() && !run.resume)
      refuse("no script was named", "give one, as in asperity run examples/quick_start.lua, or --resume RUN");
    run.confined = barriers.wanted(run);
    check_confinement(run);
    if (run.confined && (run.one_case || run.merge_only))
      refuse("a confined run takes neither `--case` nor `--merge-only`",
             "share its cases by --shard, and merge them by a run without it");
    return [given, barriers] { return given->confined ? barriers.carry_out(*given) : cli::run(*given); };
  };
}

// With --case, only the store keeps results.
void remove_case_folder(const RunCommand& command) {
  if (command.case_folder) command.case_folder->remove();
}

RunSetup setup_of(const RunCommand& command, const std::string& text) {
  RunSetup setup;
  setup.script_name = command.script;
  setup.script_text = text;
  if (command.out) setup.out = *command.out;
  if (command.resume) setup.resume = *command.resume;
  setup.anew = command.anew;
  setup.journal_lost = command.journal_lost;
  setup.lock = command.lock;
  // Other ranks' files are deleted at the end.
  setup.scratch = command.one_case || (command.ranks != nullptr && !command.ranks->leads());
  setup.store = command.store.value_or("");
  if (command.shard) setup.shard = command.shard->text();
  setup.trusted = command.trust;
  setup.barriers = command.barriers;
  setup.arguments = command.arguments;
  setup.seed = static_cast<std::int64_t>(command.seed);
  setup.threads = thread_count();
  if (!command.knobs.empty()) setup.knobs = given_knobs_json(command.knobs);
  setup.versions = lua::version_json();
  return setup;
}

// Steps of a run in a directory, in order of declaration.
class DirectoryRun {
 public:
  explicit DirectoryRun(const RunCommand& command) : command_(command), observer_(command.observer) {}

  void open_directory() {
    text_ = command_.text ? *command_.text : read_script(command_.script);
    const RunSetup setup = setup_of(command_, text_);
    stored_ = result_files(command_);
    run_ = std::make_shared<RunDirectory>(setup);
    if (!command_.store) stored_.folder = run_->store();
    // Late: moving an earlier run aside may move this folder.
    if (command_.store) make_folders(*command_.store);
    stored_.needed = run_->needed_to_resume();
  }

  void print_notices() const {
    if (const std::string notice = run_->lock_notice(); !notice.empty() && observer_ == nullptr)
      std::fprintf(stderr, "asperity: %s\n", notice.c_str());
    for (const std::string& damage : command_.damages)
      std::fprintf(stderr, "asperity: %s; the run is repeated from its script and its store\n",
                   damage.c_str());
    if (observer_ == nullptr) tell_of_few_handles();
  }

  void open_store() {
    results_.emplace(std::move(stored_));
    run_->before_its_end([this] { results_->bring_to_disk(); });
    until_.emplace(*results_, run_->journal(), command_.afresh_from.value_or(0));
    ResultStore* store = command_.afresh_from ? static_cast<ResultStore*>(&*until_) : &*results_;
    if (command_.store_limit == 0) store = nullptr;
    if (command_.ranks != nullptr) {
      // Temporary folders of other ranks would lose results.
      command_.ranks->own_store = command_.ranks->leads() || command_.store ? store : nullptr;
      store = &of_ranks_.emplace(*command_.ranks);
    }
    monitor_.keep_results_in(store);
  }

  void connect_monitor() {
    monitor_.keep_warnings_in(run_.get());
    monitor_.count_alike();
    if (command_.terminal) monitor_.show_as_on_terminal();
    if (observer_ == nullptr) return;
    monitor_.report_to(observer_);
    run_->journal().watch(
        [this](std::string_view event, const Json& fields) { observer_->recorded(event, fields); });
  }

  void set_limits() {
    watchdog_.emplace(command_.limit_time, [this](StopReason reason) { end_at_once(reason); });
    if (command_.limit_disk) unlinked_.emplace(*command_.limit_disk);
    if (command_.limit_memory) lua::limit_memory(*command_.limit_memory);
    std::signal(SIGPIPE, SIG_IGN);  // a closed pipe keeps the record
    std::signal(SIGXFSZ, SIG_IGN);  // fails as on a full disk
  }

  void carry_out(const std::function<std::string(RunContext&)>& work) {
    RunContext context{command_, text_, run_, monitor_, *watchdog_, *results_, [this] { print_summary(); }};
    try {
      if (std::string why = work(context); !why.empty()) fail(std::move(why));
    } catch (const std::exception& error) {
      fail(error.what());
    }
  }

  void check_limits() {
    // Also if the script caught the error.
    if (command_.limit_memory && lua::memory_limit_met()) {
      stop_flag().raise(StopReason::memory_limit);
      fail(status_ == done ? "the script went on with less" : why_);
    }
    if (status_ != done) stopped_ = stop_flag().reason();
    if (stopped_ == StopReason::none) return;
    status_ = exit_status(stopped_);
    if (stopped_ == StopReason::interrupt) ended_ = RunStatus::interrupted;
    // Only after a limit, not after Ctrl-C.
    const std::string met_at = stopped_ == StopReason::interrupt || why_.empty() ? "" : "\n" + why_;
    why_ = reason_text(stopped_, command_) + met_at;
  }

  void check_output() {
    monitor_.clear();
    if (const std::string fault = output_fault(); status_ == done && !fault.empty()) fail(fault);
  }

  // Returns the exit status.
  int close() {
    if (!why_.empty() && observer_ == nullptr)
      std::fprintf(stderr, "asperity: %s\n", (command_.trace ? why_ : without_calls(why_)).c_str());
    if (command_.ranks != nullptr) command_.ranks->note_failure(why_);
    try {
      if (status_ == done && run_->expectations().failed() > 0) fail(run_->expectations().summary());
      run_->finish(ended_, why_);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "asperity: %s\n", error.what());
      if (status_ == done) status_ = failed;
    }
    print_summary();
    if (observer_ != nullptr) observer_->ended(status_, stopped_, why_);
    return status_;
  }

 private:
  void fail(std::string why) {
    status_ = failed;
    ended_ = RunStatus::failed;
    why_ = std::move(why);
  }

  // In the watchdog's thread.
  void end_at_once(StopReason reason) const {
    const std::string why = reason_text(reason, command_);
    try {
      run_->finish(reason == StopReason::interrupt ? RunStatus::interrupted : RunStatus::killed, why,
                   std::chrono::milliseconds(500));
    } catch (const std::exception& error) {
      std::fprintf(stderr, "asperity: %s\n", error.what());
    }
    if (observer_ != nullptr)
      observer_->ended(exit_status(reason), reason, why);
    else
      std::fprintf(stderr, "asperity: %s; its finished part is in %s\n", why.c_str(), run_->path().c_str());
    remove_case_folder(command_);
  }

  void print_summary() {
    monitor_.tell_alike();
    if (observer_ != nullptr) return;
    const ResultFiles::Counts counts = results_->counts();
    const std::string verdicts = run_->expectations().summary();
    monitor_.clear();
    if (!verdicts.empty()) std::fprintf(stderr, "%s\n", verdicts.c_str());
    for (const Verdict& verdict : run_->expectations().verdicts())
      if (!verdict.passed) std::fprintf(stderr, "  failed: %s\n", verdict.sentence.c_str());
    std::string saved;
    if (counts.seconds_saved >= 1)
      saved = ", which had cost " + format_quantity(counts.seconds_saved, dimension::time, 3);
    if (counts.found > 0)
      std::fprintf(stderr, "%lld %s taken from the store%s\n", static_cast<long long>(counts.found),
                   counts.found == 1 ? "result was" : "results were", saved.c_str());
    if (const int pictures = pictures_left_to_page(); pictures > 0)
      std::fprintf(stderr, "pictures not drawn: %d; gnuplot does not run here, and the page draws charts\n",
                   pictures);
    for (const std::string& notice : results_->notices()) std::fprintf(stderr, "%s\n", notice.c_str());
    if (const std::string departure = run_->journal().departure(); !departure.empty())
      std::fprintf(stderr, "%s\n", departure.c_str());
    if (run_->mended()) std::fprintf(stderr, "every file is again as it was recorded\n");
    if (!command_.one_case) std::fprintf(stderr, "results in %s\n", run_->path().c_str());
  }

  const RunCommand& command_;
  RunObserver* const observer_;
  std::string text_;  // of the script
  std::shared_ptr<RunDirectory> run_;
  ResultFilesSetup stored_;
  TerminalMonitor monitor_;
  std::optional<ResultFiles> results_;
  std::optional<UntilLine> until_;
  std::optional<RankStore> of_ranks_;
  std::optional<Watchdog> watchdog_;
  std::optional<UnlinkedFilesBound> unlinked_;
  int status_ = done;
  RunStatus ended_ = RunStatus::done;
  StopReason stopped_ = StopReason::none;
  std::string why_;
};

// Digest of script, arguments and knobs.
std::string script_digest(const RunContext& context) {
  Digester script;
  script.add(context.text);
  for (const std::string& argument : context.command.arguments) script.add(argument);
  if (!context.command.knobs.empty()) script.add("knobs").add(RunKnobs(context.command.knobs).given_text());
  return script.hex();
}

lua::SharedStore shared_store(RunContext& context) {
  const RunCommand& command = context.command;
  lua::SharedStore shared;
  shared.folder = command.store.value_or("");
  shared.shard = command.shard;
  shared.one = command.one_case;
  shared.merge_only = command.merge_only;
  shared.takes = [&context](std::int64_t bytes) { return context.results.takes(bytes); };
  shared.tell = [&context](const std::string& sentence) {
    context.monitor.clear();
    if (context.command.observer == nullptr) std::fprintf(stderr, "%s\n", sentence.c_str());
  };
  shared.end = [&context, tell = shared.tell](lua::SharedEnd end, const std::string& sentence) {
    using lua::SharedEnd;
    tell(sentence);
    context.run->finish(context.command.merge_only ? RunStatus::failed : RunStatus::shard, sentence);
    context.summary();
    remove_case_folder(context.command);
    std::fflush(nullptr);
    std::_Exit(end == SharedEnd::stored    ? done
               : end == SharedEnd::failed  ? failed
               : end == SharedEnd::missing ? cases_missing
                                           : bad_usage);
  };
  return shared;
}

// os.exit of the script.
[[noreturn]] void exit_script(RunContext& context, const lua::Session& session, int code,
                              const std::function<int(int)>& at_exit) {
  const RunCommand& command = context.command;
  std::string unmade = code == 0 ? unmade_knobs(session) : "";
  if (code == 0 && unmade.empty()) unmade = output_fault();
  if (!unmade.empty() && command.observer == nullptr) std::fprintf(stderr, "asperity: %s\n", unmade.c_str());
  if (!unmade.empty() || (code == 0 && context.run->expectations().failed() > 0)) code = failed;
  const std::string why = unmade.empty() ? "os.exit(" + std::to_string(code) + ")" : unmade;
  context.run->finish(code == 0 ? RunStatus::done : RunStatus::failed, why);
  context.summary();
  if (command.observer != nullptr) command.observer->ended(code, StopReason::none, why);
  code = at_exit(code);
  if (command.ranks != nullptr) code = command.ranks->leave(code);
  std::fflush(nullptr);
  std::_Exit(code);
}

bool shares_cases(const RunCommand& command) {
  return command.shard || command.one_case || command.merge_only;
}

// With its directory, or of the resumed run; none without a run to resume.
std::optional<RunCommand> prepared(const RunCommand& asked, bool is_rank, bool leads) {
  std::optional<RunCommand> command = asked.resume ? taken_up(asked, leads) : asked;
  if (command && !asked.resume && asked.one_case && !is_rank) {
    command->case_folder = std::make_shared<const TemporaryFolder>("case");
    command->out = (command->case_folder->path() / "run").string();
  }
  if (command) return command;
  std::fprintf(stderr,
               "asperity: %s is complete, and every file is as recorded; there is nothing to resume\n",
               asked.resume->c_str());
  const std::vector<std::string> altered = altered_inputs(read_run(*asked.resume, true));
  for (const std::string& sentence : altered) std::fprintf(stderr, "%s\n", sentence.c_str());
  if (!altered.empty())
    std::fprintf(stderr, "`asperity replay %s` shows the differences\n", asked.resume->c_str());
  return {};
}

int run_as_rank(RunCommand& command, const LaunchedRank& launched,
                const std::function<std::string(RunContext&)>& work) {
  std::unique_ptr<MpiRanks> ranks;
  try {
    if (shares_cases(command))
      refuse("`--shard`, `--case` or `--merge-only` was given to one of the ranks of mpirun",
             "use one of the two: mpirun spreads the cases itself");
    if (command.threads == 0) command.threads = threads_of(launched);
    ranks = std::make_unique<MpiRanks>(launched.size);
  } catch (const Error& error) {
    if (launched.rank == 0)
      std::fprintf(stderr, "asperity: started as %d ranks: %s\n", launched.size, error.what());
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
    // Lua reports an unfinished statement at the last line with text.
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
    lua_gc(state, LUA_GCCOLLECT);  // unused iterators warn
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

std::string without_calls(const std::string& why) {
  const std::string sentence = without_traceback(why), calls = why.substr(sentence.size());
  std::istringstream lines(calls);
  bool functions = false;
  for (std::string line; std::getline(lines, line);)
    functions |= line.starts_with('\t') && !line.starts_with("\t[C]") && !line.ends_with("in main chunk");
  return sentence + (functions ? "\n  --trace shows the calls that led there" : "");
}

int in_run_directory(const RunCommand& command, const std::function<std::string(RunContext&)>& work) {
  set_thread_count(command.threads);
  DirectoryRun run(command);
  try {
    run.open_directory();
  } catch (const Error& error) {
    return refused(error);
  }
  run.print_notices();
  run.open_store();
  run.connect_monitor();
  run.set_limits();
  run.carry_out(work);
  run.check_limits();
  run.check_output();
  return run.close();
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
  session.script_digest = script_digest(context);
  const lua::SharedStore shared = shared_store(context);
  if (context.command.store) session.shared = &shared;
  if (RunObserver* observer = context.command.observer; observer != nullptr && observer->looks_at_results())
    session.onlooker = [observer](const std::string& call, const lua::Values& results) {
      observer->found(call, results);
    };
  session.ranks = context.command.ranks;
  session.exit_hook = [&](int code) { exit_script(context, session, code, at_exit); };
  const lua::State state = make_state(session, context.command);
  const Watchdog::Watching watching(context.watchdog, state.get());
  if (execute(state.get(), context.command, context.text, 0) == LUA_OK) return unmade_knobs(session);
  return lua::placed_memory_error(lua::error_text(state.get(), -1));
}

int run(const RunCommand& asked) {
  const std::optional<LaunchedRank> launched = launched_rank(shares_cases(asked));
  std::optional<RunCommand> command = prepared(asked, launched.has_value(), !launched || launched->rank == 0);
  if (!command) return done;
  const auto leave = [&command = *command](int code) {
    remove_case_folder(command);
    if (!command.one_case || code != done) return code;
    std::fprintf(stderr, "asperity: %s has ended and has no case %d.%zu; `asperity cases` lists its cases\n",
                 command.script.c_str(), command.one_case->ensemble, command.one_case->number);
    return bad_usage;
  };
  const auto work = [&leave](RunContext& context) { return run_script(context, leave); };
  return launched ? run_as_rank(*command, *launched, work) : leave(in_run_directory(*command, work));
}

}  // namespace asperity::cli
