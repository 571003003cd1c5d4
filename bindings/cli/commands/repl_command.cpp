// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity repl`: an interactive prompt, edited and completed on a terminal. Each line runs at once and
// prints its value. The first written file creates a run directory, whose script.lua has the lines without
// errors.
#include "bindings/cli/commands/repl_command.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "bindings/cli/commands/run_command.hpp"
#include "bindings/cli/commands/shared_options.hpp"
#include "bindings/cli/line_reader.hpp"
#include "bindings/cli/terminal_monitor.hpp"
#include "bindings/cli/watchdog.hpp"
#include "bindings/lua/editor/prompt.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/run.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "bindings/lua/runtime/state_heap.hpp"
#include "bindings/lua/runtime/version.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/quantity.hpp"
#include "engine/run/result_files.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::cli {

class Conversation {
 public:
  explicit Conversation(const ReplCommand& command)
      : command_(command),
        reader_(LineHistory(command.no_history ? std::filesystem::path() : LineHistory::default_file()),
                [this](std::string_view line, std::size_t position) {
                  return bench_->prompt->complete(line, position);
                }) {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    set_thread_count(command.threads);
    if (command.limit_memory) lua::limit_memory(*command.limit_memory);
    RunSetup setup;
    setup.script_name = "prompt";
    if (command.out) setup.out = *command.out;
    setup.trusted = command.trust;
    setup.seed = static_cast<std::int64_t>(command.seed);
    setup.threads = thread_count();
    setup.versions = lua::version_json();
    run_ = std::make_shared<RunDirectory>(
        std::move(setup), [this] { return bench_ ? bench_->prompt->script() : std::string(); });
    run_->note("prompt", true);
    monitor_.keep_warnings_in(run_.get());
    memory_.emplace(remembered(command));
    monitor_.keep_results_in(&*memory_);
    bench_ = make_bench({});
    hear_stops();
  }

  int converse() {
    if (reader_.terminal())
      std::printf(
          "asperity %s. help() explains, Tab completes, who lists variables, Ctrl-C stops a line, exit "
          "ends.\n",
          lua::version_text().c_str());
    std::string line;
    for (int number = 1;; ++number) {
      const LineReader::Event event = reader_.read(continued() ? ">> " : "> ", line);
      if (event == LineReader::Event::end) break;
      if (event == LineReader::Event::given_up)
        bench_->prompt->forget();
      else if (!take(line, reader_.terminal() ? 1 : number))
        break;
    }
    return end();
  }

  // False at the end of the session.
  bool take(const std::string& line, int number);
  bool continued() const { return bench_->prompt->continued(); }

 private:
  struct Bench {
    explicit Bench(Monitor& monitor) : session(monitor) {}
    lua::Session session;
    lua::State state;
    std::optional<lua::Prompt> prompt;
  };

  std::unique_ptr<Bench> make_bench(const GivenKnobs& knobs) {
    auto bench = std::make_unique<Bench>(monitor_);
    lua::Session& session = bench->session;
    session.seed = command_.seed;
    session.trusted = command_.trust;
    session.run = run_;
    session.knobs = std::make_shared<RunKnobs>(knobs);
    session.move_knob = [this](const std::string& name, const std::string& value) { moves_[name] = value; };
    session.exit_hook = [this](int code) {
      finish(code == 0 ? RunStatus::done : RunStatus::failed, "os.exit(" + std::to_string(code) + ")");
      std::fflush(nullptr);
      std::_Exit(code);
    };
    bench->state = lua::make_state(session, ".");
    bench->prompt.emplace(bench->state.get());
    return bench;
  }

  static std::int64_t remembered(const ReplCommand& command) {
    constexpr std::int64_t most = std::int64_t{256} << 20;
    return command.limit_memory ? std::min(most, *command.limit_memory / 4) : most;
  }

  // Repeats all lines with moved knobs; a failure leaves the old state.
  lua::Prompt::Outcome run_again(Watchdog& watchdog) {
    GivenKnobs knobs = knobs_;
    std::string what;
    for (const auto& [name, value] : moves_) {
      knobs[name] = value;
      what += (what.empty() ? "" : ", ") + name + " = " + value;
    }
    const ResultMemory::Counts before = memory_->counts();
    RunDirectory::Findings findings = run_->set_aside();
    std::unique_ptr<Bench> next;
    try {
      next = make_bench(knobs);
    } catch (const Error& error) {
      error_ = what + ": " + error.what();
      run_->put_back(std::move(findings));
      return lua::Prompt::Outcome::failed;
    }
    next->session.script_digest = unique_digest();
    lua::Prompt::Outcome outcome;
    {
      const Watchdog::Watching watching(watchdog, next->state.get());
      if (command_.limit_time || command_.limit_memory) lua::watch_for_stops(next->state.get());
      // An earlier stop reached the old state only.
      if (stop_flag().reason() != StopReason::none) lua::interrupt(next->state.get());
      outcome = next->prompt->run_again(bench_->prompt->script(), "now " + what);
    }
    if (outcome == lua::Prompt::Outcome::failed) {
      error_ = what + ": " + next->prompt->error() + "\nall is as it was before";
      run_->put_back(std::move(findings));
      lua::note_knobs(bench_->session);
      return outcome;
    }
    bench_ = std::move(next);
    knobs_ = std::move(knobs);
    const ResultMemory::Counts now = memory_->counts();
    std::fflush(stdout);
    monitor_.clear();
    std::fprintf(stderr, "%s: heavy results: %lld computed, %lld taken from memory\n", what.c_str(),
                 static_cast<long long>(now.missed - before.missed),
                 static_cast<long long>(now.found - before.found));
    return outcome;
  }

  // Equal lines need different digests.
  std::string unique_digest() { return "line " + std::to_string(++lines_) + " of a prompt"; }

  // Clears a stop for the next line.
  void hear_stops() {
    stop_flag().clear();
    lua_sethook(bench_->state.get(), nullptr, 0, 0);
    if (command_.limit_time || command_.limit_memory) lua::watch_for_stops(bench_->state.get());
    if (command_.limit_memory) memory::set_limit(*command_.limit_memory);
  }

  std::string reason_text(StopReason reason) const {
    if (reason == StopReason::interrupt) return "interrupted";
    return "the time limit of " + format_quantity(command_.limit_time.value_or(0), dimension::time) +
           " a line was reached";
  }

  // Only after a limit, not after Ctrl-C.
  std::string failure(StopReason stopped) const {
    if (stopped == StopReason::none) return error_;
    return reason_text(stopped) + (stopped == StopReason::interrupt ? "" : "\n" + error_);
  }

  int end() {
    int status = done;
    if (!reader_.terminal() && bench_->prompt->continued()) {
      std::fprintf(stderr, "asperity: the input ends within a statement\n");
      lines_failed_ = true;
    }
    if (!reader_.terminal() && (lines_failed_ || run_->expectations().failed() > 0)) status = failed;
    const int signal = reader_.ended_by();
    if (stopped_ || signal != 0) status = signal != 0 ? 128 + signal : exit_status(StopReason::interrupt);
    finish(status == done     ? RunStatus::done
           : status == failed ? RunStatus::failed
                              : RunStatus::interrupted,
           status == failed ? "a line or an expectation failed" : "");
    return status;
  }

  void finish(RunStatus status, const std::string& reason,
              std::chrono::milliseconds patience = std::chrono::seconds(2)) {
    try {
      run_->finish(status, reason, patience);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "asperity: %s\n", error.what());
    }
    const std::string verdicts = run_->expectations().summary();
    if (!verdicts.empty()) std::fprintf(stderr, "%s\n", verdicts.c_str());
    if (!run_->path().empty()) std::fprintf(stderr, "results in %s\n", run_->path().c_str());
  }

  const ReplCommand& command_;
  LineReader reader_;  // first: blocks signals in later threads
  TerminalMonitor monitor_;
  std::optional<ResultMemory> memory_;
  std::shared_ptr<RunDirectory> run_;
  std::unique_ptr<Bench> bench_;
  GivenKnobs knobs_, moves_;  // set; moved by this line
  std::string error_;         // of the last line
  int lines_ = 0;
  bool lines_failed_ = false, stopped_ = false;
};

bool Conversation::take(const std::string& line, int number) {
  lua::Prompt::Outcome outcome;
  bool terminated = false;
  StopReason stopped = StopReason::none;
  {
    Watchdog watchdog(
        command_.limit_time,
        [this](StopReason reason) {
          std::fprintf(stderr, "asperity: %s; it could not be stopped, and the session ends\n",
                       reason_text(reason).c_str());
          finish(RunStatus::killed, reason_text(reason), std::chrono::milliseconds(500));
        },
        reader_.terminal() ? Watchdog::CtrlC::waits : Watchdog::CtrlC::ends_within_grace);
    moves_.clear();
    {
      const Watchdog::Watching watching(watchdog, bench_->state.get());
      bench_->session.script_digest = unique_digest();
      const std::size_t knobs = bench_->session.knobs->made().size();
      outcome = bench_->prompt->take(line, number);
      error_ = bench_->prompt->error();
      if (outcome == lua::Prompt::Outcome::failed) {
        bench_->session.knobs->keep_first(knobs);
        lua::note_knobs(bench_->session);
      }
    }
    if (outcome == lua::Prompt::Outcome::done && !moves_.empty()) outcome = run_again(watchdog);
    stopped = stop_flag().reason();
    terminated = watchdog.terminated() || (stopped == StopReason::interrupt && !reader_.terminal());
  }
  hear_stops();
  monitor_.clear();
  std::fflush(stdout);
  if (outcome == lua::Prompt::Outcome::failed) {
    lines_failed_ = true;
    std::fprintf(stderr, "asperity: %s\n", failure(stopped).c_str());
  }
  if (terminated) stopped_ = true;
  return !terminated && outcome != lua::Prompt::Outcome::end;
}

PromptLines::PromptLines(const ReplCommand& command)
    : command_(command), conversation_(std::make_unique<Conversation>(command_)) {}
PromptLines::~PromptLines() = default;
bool PromptLines::take(const std::string& line) { return conversation_->take(line, 1); }
bool PromptLines::continued() const { return conversation_->continued(); }

namespace {

// Exit status: 0; from os.exit; without a terminal 1 after a failed line or expectation; 130 after a signal.
int repl(const ReplCommand& command) { return Conversation(command).converse(); }

CommandReader declare_repl(CLI::App& options) {
  const auto given = std::make_shared<ReplCommand>();
  ReplCommand& asked = *given;
  options.add_option("--out", asked.out,
                     "the run directory (default runs/prompt-<n>); made when the first file is written");
  add_machine_options(options, asked.threads, asked.limit_memory);
  add_seed(options, asked.seed);
  add_seconds(options, "--limit-time", asked.limit_time, "end a line after this long, e.g. 60s or \"2 min\"");
  options.add_flag("--no-history", asked.no_history,
                   "neither read nor keep the lines of other sessions, which are in "
                   "$XDG_STATE_HOME/asperity/history, or ~/.local/state");
  add_trust(options, asked.trust);
  options.footer(
      "help() explains, Tab completes, who lists the variables, show(surface) draws. Ctrl-C stops a line, "
      "exit, quit or Ctrl-D ends the session. From a pipe or a file the lines are read without prompts; exit "
      "status 1 where one failed.");

  return [given]() -> CommandWork { return [given] { return repl(*given); }; };
}

}  // namespace

Command repl_command() {
  return {.name = "repl",
          .sentence = "try things line by line, each value shown as it comes",
          .overview = "asperity repl [options]                        try things line by line\n",
          .prints = Prints::by_editor,
          .declare = declare_repl};
}

}  // namespace asperity::cli
