// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/confined/live_script.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <utility>

#include "bindings/cli/commands/run_command.hpp"
#include "bindings/cli/watchdog.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/registry/variation.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "bindings/lua/runtime/state_heap.hpp"
#include "bindings/web/confined/event_channel.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/error.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/quantity.hpp"
#include "engine/plot/gnuplot.hpp"
#include "engine/run/result_files.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::web {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t most_printed = std::size_t{64} << 10;
constexpr std::size_t most_live_events = 5000, most_live_views = 200;
constexpr auto time_before_a_newer =
    std::chrono::milliseconds(250);     // before a run yields to a newer question
constexpr double most_patience = 2;     // s, for slow runs
constexpr double answered_soon = 0.05;  // s; else fewer cells first
constexpr double least_factor = 1.0 / 16;

double seconds_since(Clock::time_point begun) {
  return std::chrono::duration<double>(Clock::now() - begun).count();
}

// Stores each warning once.
class LiveMonitor final : public Monitor {
 public:
  explicit LiveMonitor(ResultStore& results) : results_(results) {}
  void progress(std::string_view, double) override {}
  void warn(std::string_view sentence) override {
    const std::lock_guard lock(mutex_);
    if (warned_.emplace(sentence).second && kinds_.is_first(sentence))
      text_ += "warning: " + std::string(sentence) + "\n";
  }
  ResultStore* results() override { return &results_; }
  std::string text() {
    const std::lock_guard lock(mutex_);
    for (const std::string& line : kinds_.rest()) text_ += "warning: " + line + "\n";
    return text_;
  }

 private:
  ResultStore& results_;
  std::mutex mutex_;
  std::set<std::string> warned_;
  WarningKinds kinds_;
  std::string text_;
};

class Printed {
 public:
  Printed() {
    const int file = ::open("printed", O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC | O_APPEND, 0600);
    if (file < 0) return;
    ::dup2(file, STDOUT_FILENO);
    ::close(file);
    std::setvbuf(stdout, nullptr, _IOFBF, std::size_t{1} << 14);
  }
  void begin() {
    std::fflush(stdout);
    std::clearerr(stdout);
    (void)!::ftruncate(STDOUT_FILENO, 0);
  }
  std::string text() {
    std::fflush(stdout);
    std::string text(most_printed + 1, '\0');
    const ssize_t got = ::pread(STDOUT_FILENO, text.data(), text.size(), 0);
    text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    if (text.size() > most_printed) {
      text.resize(most_printed);
      text += "\nit printed more than is shown while a knob moves\n";
    }
    return text;
  }
};

Json output_event(const char* stream, const std::string& text) {
  return Json::object({{"type", "output"}, {"stream", stream}, {"text", text}});
}

// A newer question interrupts the run of this state, from `makes_way` on.
class Interruptible {
 public:
  Interruptible(KnobAsker& asker, lua_State* L, Clock::time_point makes_way) : asker_(asker) {
    asker_.watch(L, makes_way);
  }
  ~Interruptible() { asker_.watch(nullptr, {}); }
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

 private:
  KnobAsker& asker_;
};

class LiveScript {
 public:
  LiveScript(const ConfinedRequest& request, KnobAsker& asker)
      : request_(request),
        asker_(asker),
        memory_(std::min(std::int64_t{256} << 20, request.confinement.memory_bytes / 4)) {
    set_thread_count(request.threads);
    lua::limit_memory(request.confinement.memory_bytes);
    draw_pictures_by([](std::string_view, std::span<const GnuplotData>) {
      return GnuplotResult{"not drawn while a knob moves", ""};
    });
  }

  void answer(const KnobQuestion& question) {
    const double factor = coarse_factor();
    bool answered = false;
    if (factor < 1) {
      answered = pass(question, {factor, Clock::now() + std::chrono::seconds(5)});
      if (!answered) too_coarse_ = factor;
    }
    // A newer question replaces the full answer after a coarse one. Without a coarse answer, the run gets the
    // last run's time: a moving knob needs answers.
    if (answered && asker_.newer()) return say_outdated(question);
    const auto usual = std::chrono::duration<double>(std::min(1.5 * whole_seconds_, most_patience));
    pass(question, {1, Clock::now() + (answered ? Clock::duration(0)
                                                : std::max<Clock::duration>(
                                                      time_before_a_newer,
                                                      std::chrono::duration_cast<Clock::duration>(usual)))});
  }

 private:
  struct Pass {
    double factor = 1;
    Clock::time_point makes_way;
  };
  struct Found {
    Json::List events;
    std::vector<Seen> seen;
    std::size_t left_out = 0;
    std::string failure;
    std::optional<int> exit;  // status from os.exit
  };

  // Half the cells a side take about a quarter of the time.
  double coarse_factor() const {
    double factor = 1, seconds = whole_seconds_;
    for (; seconds > answered_soon && factor > least_factor && factor > 2 * too_coarse_; seconds /= 4)
      factor /= 2;
    return factor;
  }

  // True if an answer was sent.
  bool pass(const KnobQuestion& question, const Pass& pass);
  std::shared_ptr<RunDirectory> make_run(const KnobQuestion& question) const;
  std::string run_script(const KnobQuestion& question, const Pass& pass, LiveMonitor& monitor, Found& found,
                         Json& knobs);
  void say(const KnobQuestion& question, Found found, Json answer);
  void say_outdated(const KnobQuestion& question) {
    asker_.send(Json::object({{"move", question.move}, {"part", "outdated"}}), {});
  }
  std::string limit_text() const {
    return "the time limit of " + format_quantity(request_.seconds, dimension::time) + " was reached";
  }

  const ConfinedRequest& request_;
  KnobAsker& asker_;
  ResultMemory memory_;
  Printed printed_;
  double whole_seconds_ = 0;  // s, last full computation
  bool first_ = true;
  double too_coarse_ = 0;  // too few cells for the script
};

bool LiveScript::pass(const KnobQuestion& question, const Pass& pass) {
  const Clock::time_point begun = Clock::now();
  const ResultMemory::Counts before = memory_.counts();
  LiveMonitor monitor(memory_);
  Found found;
  Json knobs;
  stop_flag().clear();
  memory::set_limit(request_.confinement.memory_bytes);
  printed_.begin();
  try {
    found.failure = run_script(question, pass, monitor, found, knobs);
  } catch (const std::exception& error) {
    found.failure = error.what();
  }
  const StopReason stopped = stop_flag().reason();
  stop_flag().clear();
  const double seconds = seconds_since(begun);
  // The first run fills the result memory; recalled runs count only if slower.
  const ResultMemory::Counts now = memory_.counts();
  if (pass.factor == 1 && (seconds > whole_seconds_ || now.missed > before.missed))
    whole_seconds_ = std::exchange(first_, false) ? 0 : seconds;
  if (stopped == StopReason::interrupt && !found.exit) {
    say_outdated(question);
    return true;
  }
  if (stopped == StopReason::time_limit) found.failure = limit_text();

  if (const std::string text = printed_.text(); !text.empty())
    found.events.push_back(output_event("out", text));
  if (const std::string text = monitor.text(); !text.empty())
    found.events.push_back(output_event("err", text));
  if (!found.failure.empty()) found.events.push_back(error_event(found.failure));
  // Perhaps due to coarse cells: the full answer decides.
  if (pass.factor < 1 && !found.failure.empty()) return false;
  Json answer = Json::object({{"move", question.move},
                              {"part", pass.factor < 1 ? "coarse" : "whole"},
                              {"factor", pass.factor},
                              {"seconds", seconds},
                              {"computed", now.missed - before.missed},
                              {"recalled", now.found - before.found},
                              {"knobs", std::move(knobs)}});
  if (found.exit) answer.set("exit", *found.exit);
  say(question, std::move(found), std::move(answer));
  return true;
}

std::shared_ptr<RunDirectory> LiveScript::make_run(const KnobQuestion& question) const {
  std::error_code ignored;
  fs::remove_all("run", ignored);
  RunSetup setup;
  setup.script_name = page_script;
  setup.script_text = request_.script;
  setup.out = "run";
  setup.scratch = true;
  setup.seed = request_.seed;
  setup.threads = thread_count();
  if (!question.knobs.empty()) setup.knobs = given_knobs_json(question.knobs);
  return std::make_shared<RunDirectory>(setup);
}

// Returns the reason of a failure, or "".
std::string LiveScript::run_script(const KnobQuestion& question, const Pass& pass, LiveMonitor& monitor,
                                   Found& found, Json& knobs) {
  cli::RunCommand command;
  command.script = page_script;
  command.seed = static_cast<std::uint64_t>(request_.seed);
  command.knobs = question.knobs;
  if (cli::Watchdog::has_clock) command.limit_time = request_.seconds;

  lua::Session session(monitor);
  session.run = make_run(question);
  session.run->journal().watch([&found, &monitor](std::string_view event, const Json& fields) {
    std::optional<Json> told = told_of(event, fields);
    if (!told) return;
    if (found.events.size() == most_live_events)
      monitor.warn("rows and expectations past the first " + std::to_string(most_live_events) +
                   " are not shown while a knob moves");
    if (found.events.size() < most_live_events) found.events.push_back(*std::move(told));
  });
  session.onlooker = [&found](const std::string& call, const lua::Values& results) {
    for (Seen& seen : seen_in(call, results)) {
      if (found.seen.size() < most_live_views)
        found.seen.push_back(std::move(seen));
      else
        ++found.left_out;
    }
  };
  // After os.exit the process stays for its result memory.
  lua_State* running_state = nullptr;
  session.exit_hook = [&](int code) {
    found.exit = code;
    stop_flag().raise(StopReason::interrupt);
    lua::interrupt(running_state);
    throw Error(ErrorCode::interrupted, "the script ended itself");
  };
  if (pass.factor < 1) {
    session.refinement = std::make_shared<lua::Refinement>();
    session.refinement->cells_factor = pass.factor;
  }
  Digester digest;
  digest.add(request_.script).add(pass.factor);
  if (!question.knobs.empty()) digest.add("knobs").add(RunKnobs(question.knobs).given_text());
  session.script_digest = digest.hex();

  const std::optional<double> limit =
      cli::Watchdog::has_clock ? std::optional(request_.seconds) : std::nullopt;
  cli::Watchdog watchdog(limit, [&](StopReason) {
    asker_.send(Json::object({{"move", question.move}, {"part", "ended"}, {"why", limit_text()}}), {});
  });
  const lua::State state = cli::make_state(session, command);
  running_state = state.get();
  const cli::Watchdog::Watching watching(watchdog, state.get());
  const Interruptible running(asker_, state.get(), pass.makes_way);
  const bool good = cli::execute(state.get(), command, request_.script, 0) == LUA_OK;
  knobs = session.knobs->json();
  if (found.exit && *found.exit != 0)
    return "the script ended itself by os.exit(" + std::to_string(*found.exit) + ")";
  return good || found.exit ? cli::unmade_knobs(session)
                            : lua::placed_memory_error(lua::error_text(state.get(), -1));
}

void LiveScript::say(const KnobQuestion& question, Found found, Json answer) {
  Json::List views;
  std::map<std::string, int> of_kind;
  const Seen* looked_at = nullptr;
  std::string name_of_it;
  for (const Seen& seen : found.seen) {
    const std::string kind = seen.kind();
    const std::string name = kind + "-" + std::to_string(++of_kind[kind]);
    views.push_back(Json::object({{"name", name}, {"title", seen.title()}}));
    // The requested view, else the last.
    if (name_of_it != question.view || question.view.empty()) {
      looked_at = &seen;
      name_of_it = name;
    }
  }
  View view;
  if (looked_at != nullptr) view = looked_at->view();
  if (found.left_out > 0)
    found.events.push_back(Json::object({{"type", "views_left_out"}, {"count", found.left_out}}));
  answer.set("events", std::move(found.events)).set("views", std::move(views));
  if (looked_at != nullptr)
    answer.set("view", Json::object({{"name", name_of_it}, {"title", view.title}, {"fields", view.fields}}));
  const bool whole = answer["factor"].number() == 1;
  const auto in_view = std::ranges::find_if(
      view.fields, [&](const Json& field) { return field["name"].string() == question.map; });
  const auto first = in_view - view.fields.begin();
  if (!whole || in_view == view.fields.end() || view.fields.size() == 1)
    return asker_.send(answer, view.values);
  asker_.send(answer.set("first", first), {std::move(view.values[static_cast<std::size_t>(first)])});
  view.values.erase(view.values.begin() + first);
  asker_.send(Json::object({{"move", question.move}, {"part", "others"}}), view.values);
}

}  // namespace

KnobQuestion knob_question(const std::string& text) {
  const Json json = Json::parse(text, "a question");
  KnobQuestion question;
  question.move = static_cast<std::int64_t>(json["move"].number());
  for (const auto& [name, value] : json["knobs"].members()) give_knob(question.knobs, name, value.string());
  question.view = json["view"].string();
  question.map = json["map"].string();
  return question;
}

std::function<void(const KnobQuestion&)> live_script(const ConfinedRequest& request, KnobAsker& asker) {
  return [script = std::make_shared<LiveScript>(request, asker)](const KnobQuestion& question) {
    script->answer(question);
  };
}

}  // namespace asperity::web
