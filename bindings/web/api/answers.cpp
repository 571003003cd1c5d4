// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/api/answers.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bindings/web/api/script_answers.hpp"
#include "bindings/web/sandbox/plain_files.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/require.hpp"

namespace asperity::web {

namespace {

constexpr double check_seconds = 3;
constexpr std::chrono::seconds check_while_others_wait{1};

HttpResponse file_stream(OpenFile file, const std::string& type, bool as_download) {
  auto reader = std::make_shared<Descriptor>(std::move(file.file));
  HttpResponse response = stream_answer(type, [reader, left = file.bytes](std::string& piece) mutable {
    piece.resize(static_cast<std::size_t>(std::min<std::int64_t>(left, std::int64_t{64} << 10)));
    const ssize_t got = piece.empty() ? 0 : ::read(reader->get(), piece.data(), piece.size());
    piece.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    left -= static_cast<std::int64_t>(piece.size());
    return !piece.empty() && left > 0;
  });
  if (as_download) response.headers.emplace_back("Content-Disposition", "attachment");
  return response;
}

}  // namespace

HttpResponse json_answer(const Json& json, int status) {
  return {.status = status,
          .headers = {{"Cache-Control", "no-store"}},
          .type = "application/json",
          .body = json.text() + "\n"};
}

HttpResponse stream_answer(std::string type, std::function<bool(std::string&)> stream) {
  return {.headers = {{"Cache-Control", "no-store"}}, .type = std::move(type), .stream = std::move(stream)};
}

HttpResponse problem_answer(int status, const std::string& message, const std::string& hint) {
  Json problem = Json::object({{"message", message}});
  if (!hint.empty()) problem.set("hint", hint);
  return json_answer(Json::object({{"error", problem}}), status);
}

Json body_of(const HttpRequest& request) {
  Json body = Json::parse(request.body, "the body of the request");
  if (!body.is_object()) refuse("the body of the request is no object");
  return body;
}

std::string text_member(const Json& body, const std::string& key, std::size_t longest) {
  const Json* found = body.find(key);
  if (found == nullptr) refuse("the request has no " + asperity::quoted(key));
  if (!found->is_string()) refuse(asperity::quoted(key) + " is no text");
  const std::string& text = found->string();
  if (text.size() > longest)
    refuse(asperity::quoted(key) + " has " + std::to_string(text.size()) + " bytes",
           "give at most " + std::to_string(longest));
  return text;
}

std::int64_t whole_member(const Json& body, const std::string& key, std::int64_t otherwise) {
  if (body[key].is_null()) return otherwise;
  const double number = body[key].number();
  if (!(number >= 0 && number <= 1e15) || number != std::floor(number))
    refuse(asperity::quoted(key) + " is " + format_short(number), "give a whole number from 0 on");
  return static_cast<std::int64_t>(number);
}

GivenKnobs knobs_member(const Json& body, const std::string& key) {
  constexpr std::size_t most = 100, longest = 100;
  const Json& given = body[key];
  if (given.is_null()) return {};
  if (!given.is_object()) refuse(asperity::quoted(key) + " is no object");
  const Json::Members& members = given.members();
  if (members.size() > most)
    refuse(asperity::quoted(key) + " has " + std::to_string(members.size()) + " members",
           "give at most " + std::to_string(most));
  GivenKnobs knobs;
  for (const auto& [name, value] : members) {
    if (!value.is_string())
      refuse("the value of " + asperity::quoted(name) + " is no text",
             "give a number with its unit in quotes, such as \"50 MPa\"");
    if (value.string().size() > longest) refuse("the value of " + asperity::quoted(name) + " is too long");
    give_knob(knobs, name, value.string());
  }
  return knobs;
}

bool flag_member(const Json& body, const std::string& key) {
  return !body[key].is_null() && body[key].boolean();
}

HttpResponse events_answer(const std::shared_ptr<PageRun>& run, const HttpRequest& request) {
  std::int64_t after = 0;
  if (const auto given = request.parameters.find("after"); given != request.parameters.end()) {
    const auto number = count_in(given->second);
    if (!number) return problem_answer(400, "`after` is the number of an event");
    after = static_cast<std::int64_t>(std::min<std::uint64_t>(*number, INT64_MAX));
  }
  const auto until = std::chrono::steady_clock::now() + std::chrono::minutes(5);
  return stream_answer("application/x-ndjson", [run, after, until](std::string& piece) mutable {
    bool more = true;
    piece = run->events.after(after, std::chrono::milliseconds(500), more);
    return more && std::chrono::steady_clock::now() < until;
  });
}

HttpResponse file_answer(const PageRun& run, const std::string& name) {
  const bool hidden = name.starts_with('.') || name.find("/.") != std::string::npos;
  auto file = hidden ? std::nullopt : open_plain_file(run.directory, name);
  if (!file) return problem_answer(404, "the run has no such file");
  // A script's file must not act as a page of this server.
  const std::string type = media_type(name);
  const bool harmless = type.starts_with("text/plain") || type.starts_with("text/csv") || type == "image/png";
  return file_stream(*std::move(file),
                     type.starts_with("text/html") || type.starts_with("text/javascript")
                         ? "text/plain; charset=utf-8"
                         : type,
                     !harmless);
}

HttpResponse view_answer(const PageRun& run, const std::string& name) {
  const bool plain = !name.empty() && name.size() < 64 && std::ranges::all_of(name, [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
  auto file = plain ? open_plain_file(run.directory, ".views/" + name + ".json") : std::nullopt;
  if (!file) return problem_answer(404, "the run has no such view");
  return file_stream(*std::move(file), "application/json", false);
}

Json check_script(const std::string& script, const std::filesystem::path& scratch,
                  const std::vector<std::string>& barriers, const std::function<bool()>& others_wait) {
  const TemporaryFolder folder("check", scratch);

  ConfinedRequest request{.work = Work::check, .confinement = {}};
  request.confinement.memory_bytes = std::int64_t{512} << 20;
  request.confinement.file_bytes = 1 << 16;
  request.confinement.processor_seconds = static_cast<std::int64_t>(check_seconds) + 2;
  request.script = script;
  request.seconds = check_seconds;
  request.barriers = barriers;
  const auto until = std::chrono::steady_clock::now() + check_while_others_wait;
  const auto given_up = [&] { return std::chrono::steady_clock::now() > until && others_wait(); };
  const Finished done =
      run_confined(request, folder.path().string(), check_seconds + 3, std::size_t{1} << 20, given_up);

  Json answer = check_answer(done.events);
  if (answer.find("marks") != nullptr) return answer;
  if (done.status == 2) refuse_state("the script could not be checked: " + done.error);
  return answer.set(
      "marks", Json::List{note(done.given_up ? "the check was ended after 1 s, because others wait for theirs"
                                             : "the check did not come to an end")});
}

}  // namespace asperity::web
