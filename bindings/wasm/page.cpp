// SPDX-License-Identifier: GPL-3.0-or-later
// The laboratory as functions for the page in a browser, instead of the server's addresses. Questions and
// answers are JSON. Each run has its own worker, which the page ends to stop the run.
#include <emscripten.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "bindings/cli/commands/repl_command.hpp"
#include "bindings/cli/commands/replay_command.hpp"
#include "bindings/cli/commands/run_command.hpp"
#include "bindings/lua/editor/lessons.hpp"
#include "bindings/lua/runtime/version.hpp"
#include "bindings/web/api/script_answers.hpp"
#include "bindings/web/confined/confined_request.hpp"
#include "bindings/web/confined/event_channel.hpp"
#include "bindings/web/confined/live_script.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/json.hpp"
#include "engine/core/text.hpp"
#include "engine/plot/gnuplot.hpp"
#include "engine/run/run_knobs.hpp"

// An event of a run, as one line of JSON.
EM_JS(void, tell_page, (const char* line), { Module.told(UTF8ToString(line)); });
// The answer of a live script: JSON, and `count` fields in single precision.
EM_JS(void, answer_page, (const char* text, const float* const* fields, const int* sizes, int count), {
  const numbers = [];
  for (let k = 0; k < count; ++k) {
    const begin = HEAPU32[(fields >> 2) + k] >> 2;
    numbers.push(HEAPF32.slice(begin, begin + HEAP32[(sizes >> 2) + k]));
  }
  Module.answered(UTF8ToString(text), numbers);
});

namespace asperity::web {
namespace {

constexpr std::int64_t most_memory = std::int64_t{3} << 30;  // of 4 GiB that 32 bits address
constexpr const char* run_folder = "/run";

std::string text_of(const Json& asked, const char* name) {
  const Json* found = asked.find(name);
  return found == nullptr ? std::string() : found->string();
}

// {script, knobs?}
ConfinedRequest request_in(const Json& asked, Work work) {
  ConfinedRequest request{.work = work, .confinement = {}};
  request.confinement.memory_bytes = most_memory;
  request.script = text_of(asked, "script");
  request.views = work == Work::run;
  if (const Json* knobs = asked.find("knobs"))
    for (const auto& [name, value] : knobs->members()) give_knob(request.knobs, name, value.string());
  return request;
}

// Without a clock there is no limit of time; the browser limits files.
cli::RunCommand command_of(const ConfinedRequest& request, cli::RunObserver& observer) {
  cli::RunCommand command = page_command(request, observer);
  command.out = run_folder;
  command.limit_time.reset();
  command.limit_disk.reset();
  return command;
}

Json check(const Json& asked) {
  std::string events;
  EventChannel channel([&events](const std::string& line) { events += line; }, "");
  cli::check(command_of(request_in(asked, Work::check), channel));
  return check_answer(events);
}

Json answer_to(const Json& asked) {
  const std::string what = text_of(asked, "ask");
  if (what == "version") return Json(lua::version_text());
  if (what == "lessons") return lesson_entries(lua::lessons(), false);
  if (what == "lesson") return lesson_answer(lua::find_lesson(text_of(asked, "name")), false);
  if (what == "check") return check(asked);
  if (what != "complete") refuse_name("the page asks for " + asperity::quoted(what));
  const Json* position = asked.find("position");
  return completion_of(text_of(asked, "text"),
                       position == nullptr ? 0 : static_cast<std::size_t>(position->number()));
}

// The page asks again only after the answer.
class PageAsker final : public KnobAsker {
 public:
  bool newer() override { return false; }
  void watch(lua_State*, std::chrono::steady_clock::time_point) override {}
  void send(const Json& answer, const std::vector<std::vector<float>>& fields) override {
    std::vector<const float*> places;
    std::vector<int> sizes;
    for (const auto& field : fields) {
      places.push_back(field.data());
      sizes.push_back(static_cast<int>(field.size()));
    }
    answer_page(answer.text().c_str(), places.data(), sizes.data(), static_cast<int>(fields.size()));
  }
};

// A live script keeps references to its request and its asker.
struct Live {
  ConfinedRequest request;
  PageAsker asker{};
  std::function<void(const KnobQuestion&)> answer = live_script(request, asker);
};

// Errors of scripts are events; another error is one line on standard error.
template <class Act>
int guarded(Act act) {
  try {
    return act();
  } catch (const std::exception& error) {
    return cli::refused(error);
  }
}

}  // namespace
}  // namespace asperity::web

extern "C" {

// {ask: "version" | "lessons" | "lesson", name | "check", script | "complete", text, position}. The answer,
// or {error: {message, hint}}, is valid until the next call.
EMSCRIPTEN_KEEPALIVE const char* asperity_ask(const char* question) {
  using namespace asperity;
  static std::string answer;
  try {
    answer = web::answer_to(Json::parse(question, "the question")).text();
  } catch (const Error& error) {
    answer = Json::object({{"error", Json::object({{"message", error.sentence()}, {"hint", error.hint()}})}})
                 .text();
  } catch (const std::exception& error) {
    answer = Json::object({{"error", Json::object({{"message", error.what()}, {"hint", ""}})}}).text();
  }
  return answer.c_str();
}

// Runs a script: it writes /run, and reads files relative to the working directory. Returns the exit status.
EMSCRIPTEN_KEEPALIVE int asperity_run(const char* asked) {
  using namespace asperity::web;
  return guarded([asked] {
    EventChannel events([](const std::string& line) { tell_page(line.c_str()); },
                        std::string(run_folder) + "/.views");
    std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
    const ConfinedRequest request = request_in(asperity::Json::parse(asked, "the request"), Work::run);
    const int status = asperity::cli::run(command_of(request, events));
    std::fflush(nullptr);
    return status;
  });
}

// Replays the run directory `recorded` into a folder of /run. Returns the exit status.
EMSCRIPTEN_KEEPALIVE int asperity_replay(const char* recorded) {
  return asperity::web::guarded([recorded] {
    asperity::cli::ReplayCommand command{};
    command.recorded = recorded;
    command.run.out = std::string(asperity::web::run_folder) + "/again";
    const int status = asperity::cli::replay(command);
    std::fflush(nullptr);
    return status;
  });
}

// Takes a line of the prompt. Returns 0, 1 for an incomplete statement, 2 at the end of the session.
EMSCRIPTEN_KEEPALIVE int asperity_line(const char* line) {
  using asperity::cli::PromptLines;
  static std::unique_ptr<PromptLines> prompt;
  return asperity::web::guarded([line] {
    if (!prompt)
      prompt = std::make_unique<PromptLines>(
          asperity::cli::ReplCommand{.out = asperity::web::run_folder, .no_history = true});
    const int charts = asperity::pictures_left_to_page();
    const bool goes_on = prompt->take(line);
    if (asperity::pictures_left_to_page() > charts)
      std::fputs("charts are drawn for scripts: put these lines into the editor, and run them\n", stderr);
    return !goes_on ? 2 : prompt->continued() ? 1 : 0;
  });
}

// Answers a question of the live script; the first call has the script: {script, move, knobs, view, map}.
// Returns 0, or the exit status of an error.
EMSCRIPTEN_KEEPALIVE int asperity_move(const char* question) {
  using namespace asperity::web;
  static std::unique_ptr<Live> live;
  return guarded([question] {
    if (!live) live.reset(new Live{request_in(asperity::Json::parse(question, "a question"), Work::live)});
    live->answer(knob_question(question));
    return 0;
  });
}
}
