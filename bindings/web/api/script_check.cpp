// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <cstdlib>
#include <sstream>

#include "bindings/web/confined/confined_process.hpp"
#include "bindings/web/runs/answers.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/temporary_folder.hpp"

namespace asperity::web {

namespace {

constexpr double seconds = 3;

std::optional<std::int64_t> line_in(const std::string& reached) {
  const std::string lead = "to line ";
  if (!reached.starts_with(lead)) return {};
  const std::int64_t line = std::strtoll(reached.c_str() + lead.size(), nullptr, 10);
  return line > 0 ? std::optional(line) : std::nullopt;
}

Json mark(const char* severity, const std::string& message, const Json* line) {
  return Json::object(
      {{"line", line == nullptr ? Json(1) : *line}, {"severity", severity}, {"message", message}});
}

}  // namespace

Json check_script(const std::string& script, const std::filesystem::path& scratch,
                  const std::vector<std::string>& barriers) {
  const TemporaryFolder folder("check", scratch);

  ConfinedRequest request{.work = Work::check, .confinement = {}};
  request.confinement.memory_bytes = std::int64_t{512} << 20;
  request.confinement.file_bytes = 1 << 16;
  request.confinement.processor_seconds = static_cast<std::int64_t>(seconds) + 2;
  request.script = script;
  request.name = "script.lua";
  request.seconds = seconds;
  request.barriers = barriers;
  const Finished done =
      run_confined(request, folder.path().string(),
                   std::chrono::milliseconds(static_cast<int>(1000 * seconds) + 3000), std::size_t{1} << 20);

  Json::List marks;
  Json answer = Json::object();
  bool ended = false;
  std::istringstream lines(done.events);
  for (std::string line; std::getline(lines, line);) {
    try {
      const Json event = Json::parse(line, "an event");
      const Json *type = event.find("type"), *message = event.find("message"), *why = event.find("why");
      if (type == nullptr) continue;
      if (type->string() == "error" && message != nullptr)
        marks.push_back(mark("error", message->string(), event.find("line")));
      if (const Json* knobs = event.find("knobs"); knobs != nullptr && !knobs->members().empty())
        answer.set("knobs", *knobs);
      if (type->string() != "ended" || why == nullptr) continue;
      ended = true;
      if (const auto reached = line_in(why->string())) answer.set("checked_to", *reached);
    } catch (const Error&) {
      continue;
    }
  }
  if (!ended && marks.empty()) {
    if (done.status == 2) throw Error(ErrorCode::bad_state, "the script could not be checked: " + done.error);
    marks.push_back(mark("note", "the check did not come to an end", nullptr));
  }
  answer.set("marks", std::move(marks));
  return answer;
}

}  // namespace asperity::web
