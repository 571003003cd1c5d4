// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity accuracy`: a work-precision study of a script that returns a number. The script runs with scaled
// `cells` and other contact tolerances.
#include <unistd.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <utility>

#include "bindings/cli/commands/run_command.hpp"
#include "bindings/cli/commands/shared_options.hpp"
#include "bindings/cli/plain_streams.hpp"
#include "bindings/cli/terminal_monitor.hpp"
#include "bindings/cli/watchdog.hpp"
#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/variation.hpp"
#include "bindings/lua/study/study.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/require.hpp"
#include "engine/run/run_directory.hpp"
#include "engine/study/study_result.hpp"

namespace asperity::cli {

namespace {

struct AccuracyCommand {
  RunCommand run;
  std::optional<double> at_most;  // seconds, in all; default 5 min
  int repeats = 3;                // timed, for each setting
  std::optional<double> truth;    // SI; default: finest grid
};

constexpr const char* study_name = "accuracy";
constexpr const char* wanted =
    "`asperity accuracy` studies a script that returns one number: end it with one, as in `return "
    "st.area_fraction`";

class ScriptRun {
 public:
  ScriptRun(RunContext& context, std::shared_ptr<RunDirectory> run,
            std::shared_ptr<lua::Refinement> refinement)
      : context_(context), session_(context.monitor) {
    session_.run = std::move(run);
    session_.refinement = std::move(refinement);
    session_.exit_hook = [this](int) {
      const std::string why = std::string("the script ended by os.exit; ") + wanted;
      context_.run->finish(RunStatus::failed, why);
      context_.monitor.clear();
      std::fprintf(stderr, "asperity: %s\n", why.c_str());
      std::fflush(nullptr);
      std::_Exit(1);
    };
    state_ = make_state(session_, context.command);
    watching_.emplace(context.watchdog, state_.get());
  }

  StudyAnswer result(Monitor& monitor) {
    const lua::Session::Reporting reporting(session_, monitor);
    lua_State* const L = state_.get();
    if (execute(L, context_.command, context_.text, 2) != LUA_OK) {
      stop_flag().check();
      return {{}, lua::error_text(L, -1)};
    }
    if (const std::string unmade = unmade_knobs(session_); !unmade.empty()) refuse_name(unmade);
    const lua::Argument value(L, -2), message(L, -1);
    if (value.is_number()) return {value.number(), ""};
    if (value.is_nil()) return {{}, message.is_text() ? std::string(message.text()) : std::string()};
    refuse("the script returned " + value.describe(), wanted);
  }

 private:
  RunContext& context_;
  lua::Session session_;
  lua::State state_;
  std::optional<Watchdog::Watching> watching_;  // destroyed before the state
};

class ScriptWork final : public StudyWork {
 public:
  explicit ScriptWork(RunContext& context) : context_(context) {}

  void prepare(const Knobs& knobs) override {
    ready_.reset();
    scratch_.emplace("accuracy");
    RunSetup setup;
    setup.script_name = context_.command.script;
    setup.script_text = context_.text;
    setup.out = scratch_->path() / "run";
    setup.scratch = true;
    setup.trusted = context_.command.trust;
    setup.arguments = context_.command.arguments;
    setup.seed = static_cast<std::int64_t>(context_.command.seed);
    setup.threads = thread_count();
    auto refinement = std::make_shared<lua::Refinement>();
    refinement->cells_factor = number_of(knobs, "cells_factor").value_or(1);
    refinement->tolerance = number_of(knobs, "tolerance");
    ready_.emplace(context_, std::make_shared<RunDirectory>(setup), std::move(refinement));
  }
  StudyAnswer ask(const Knobs&, Monitor& monitor) override { return ready_->result(monitor); }
  void record(std::span<const StudyRun> runs) override {
    lua::record_calls(context_.run.get(), study_name, runs);
  }

 private:
  RunContext& context_;
  std::optional<TemporaryFolder> scratch_;
  std::optional<ScriptRun> ready_;
};

struct FirstRun {
  double seconds = 0;
  std::shared_ptr<lua::Refinement> used = std::make_shared<lua::Refinement>();
};

// In the run directory; notes grids and contacts.
FirstRun run_as_written(RunContext& context) {
  FirstRun first;
  ScriptRun run(context, context.run, first.used);
  const double begun = WorkPrecision::steady_seconds();
  const StudyAnswer answer = run.result(context.monitor);
  first.seconds = WorkPrecision::steady_seconds() - begun;
  if (answer.value) return first;
  if (!answer.failure.empty()) refuse(answer.failure);
  refuse("the script returned nothing", wanted);
}

StudyWay way(const std::string& name, std::vector<double> factors, std::vector<double> tolerances) {
  std::vector<KnobSweep> knobs;
  const auto add = [&](const char* knob, const std::vector<double>& values) {
    if (values.empty()) return;
    KnobSweep sweep{knob, {}, values.size() > 1};
    sweep.values.assign(values.begin(), values.end());
    knobs.push_back(std::move(sweep));
  };
  add("cells_factor", factors);
  add("tolerance", tolerances);
  return make_way(name, std::move(knobs));
}

StudyRequest plan(const AccuracyCommand& command, const FirstRun& first, Monitor& monitor) {
  const bool grids = first.used->grids > 0, contacts = first.used->contacts > 0;
  if (!grids && !contacts)
    refuse("the script has no `cells` of a surface and no contact to make finer",
           "write a study of its own with lab.work_precision");
  const double at_most = command.at_most.value_or(300);
  StudyRequest request;
  request.repeats = command.repeats;
  request.at_most = std::max(at_most - first.seconds, 1e-9);
  // Twice the cells cost just over four times as much; the reference may use half of the time.
  const double finest = command.truth || 4.4 * first.seconds < 0.5 * at_most ? 2 : 1;
  if (grids) {
    std::vector<double> factors;
    for (const double factor : {0.25, 0.5, 1.0, 2.0})
      if (command.truth || factor < finest) factors.push_back(factor);
    request.ways.push_back(way("finer grid", factors, {}));
  }
  if (contacts) request.ways.push_back(way("tighter tolerance", {}, {1e-2, 1e-3, 1e-4, 1e-6, 1e-8}));
  if (command.truth) {
    request.truth = *command.truth;
    return request;
  }
  const double tightest = grids ? 1e-8 : 1e-10;
  request.truth = way("truth", grids ? std::vector<double>{finest} : std::vector<double>{},
                      contacts ? std::vector<double>{std::min(first.used->tightest.load(), tightest)}
                               : std::vector<double>{})
                      .settings.front();
  if (grids && finest == 1)
    monitor.inform(
        "a grid twice as fine would take more than half of the time: the script's own grid is the truth");
  return request;
}

double exact_value(const std::string& text) {
  try {
    return parse_quantity(text).value;
  } catch (const Error& error) {
    throw Error(error.code(), "the truth is " + asperity::quoted(text) + ": " + error.sentence(),
                "give a number, or a quantity such as \"0.1 um\"");
  }
}

// As cli::run; also 1 without a number or something to vary.
int accuracy(const AccuracyCommand& command) {
  return in_run_directory(command.run, [&command](RunContext& context) -> std::string {
    const FirstRun first = run_as_written(context);
    std::fflush(stdout);
    ScriptWork work(context);
    WorkPrecision study(plan(command, first, context.monitor), work, context.monitor);
    lua::record_request(context.run.get(), study_name, study.result().request);
    try {
      const Muted muted;
      study.run();
    } catch (const std::exception&) {
      lua::record_result(context.run.get(), study_name, study.result());
      throw;
    }
    const StudyResult& result = study.result();
    lua::record_result(context.run.get(), study_name, result);
    context.monitor.clear();
    std::printf("%s\n", study_text(result).c_str());
    if (first.used->grids > 0)
      std::printf(
          "cells_factor multiplies every `cells` that the script gives; without it they are as written.\n");
    if (first.used->contacts > 0)
      std::printf("tolerance replaces that of every contact; the script's own is %s at the tightest.\n",
                  format_short(first.used->tightest.load()).c_str());
    std::fflush(stdout);
    const LineChart chart = study_chart(result, context.command.script);
    const std::filesystem::path file = context.run->path_for(std::string(study_name) + ".svg");
    for (const std::string& warning : draw(chart, file)) context.monitor.warn(warning);
    return "";
  });
}

CommandReader declare_accuracy(CLI::App& options) {
  const auto given = std::make_shared<AccuracyCommand>();
  RunCommand& run = given->run;
  add_script_options(options, run);
  add_run_options(options, run);
  add_knobs(options, run.knobs);
  add_trust(options, run.trust);
  add_seconds(options, "--at-most", given->at_most,
              "time for all runs together (default 5 min); quoted first and kept");
  options.add_option("--repeats", given->repeats, "timed runs of each setting (default 3)")
      ->check(CLI::Range(1, 100000));
  options.add_option_function<std::string>(
      "--truth",
      [given](const std::string& text) {
        if (!text.empty()) given->truth = exact_value(text);
      },
      "the exact value, a number or a quantity such as \"0.1 um\"; without it the finest grid "
      "is taken for it");
  options.footer(
      "The first run is the script as it is written: its output is shown and its files are kept. What the "
      "repeated runs print and write is dropped. The table goes to standard output, accuracy.csv and "
      "accuracy.svg to the run directory.");

  return [given]() -> CommandWork { return [given] { return accuracy(*given); }; };
}

}  // namespace

Command accuracy_command() {
  return {.name = "accuracy",
          .sentence =
              "what accuracy costs a script that returns a number: it is run again on coarser and finer "
              "grids (every `cells` times 1/4, 1/2, 1, 2, rounded) and with looser and tighter contacts, and "
              "each is timed",
          .overview =
              "asperity accuracy SCRIPT [options]             what accuracy costs a script that returns a "
              "number\n",
          .prints = Prints::of_script,
          .declare = declare_accuracy};
}

}  // namespace asperity::cli
