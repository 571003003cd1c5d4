// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/api/api.hpp"

#include <sha2.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>
#include <utility>

#include "bindings/lua/runtime/version.hpp"
#include "bindings/web/api/answers.hpp"
#include "bindings/web/api/lesson_folder.hpp"
#include "bindings/web/api/script_answers.hpp"
#include "bindings/web/confined/event_channel.hpp"
#include "bindings/web/sandbox/plain_files.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/require.hpp"

namespace asperity::web {

namespace {

constexpr std::size_t longest_script = std::size_t{1} << 20, longest_name = 200;
constexpr std::chrono::seconds longest_wait{8};

Json facts_of(const PageRun& run) {
  return Json::object({{"id", run.id}, {"name", run.request.name}, {"state", name(run.state())}});
}

HttpResponse too_many_answers() {
  return problem_answer(429, "too many requests of this person are open", "close other pages");
}

HttpResponse not_there() { return problem_answer(404, "there is nothing at this address"); }

std::pair<std::string, std::string> split(const std::string& path) {
  const std::size_t slash = path.find('/');
  if (slash == std::string::npos) return {path, ""};
  return {path.substr(0, slash), path.substr(slash + 1)};
}

// Also with "; charset=utf-8".
bool is_json(const std::string& type) {
  std::string kind = lower_case(type.substr(0, type.find(';')));
  kind.erase(kind.find_last_not_of(" \t") + 1);
  return kind == "application/json";
}

// Content policy: load from this server only; scripts are its files and `inline_scripts`.
void add_safe_headers(HttpResponse& response, const std::string& inline_scripts = {}) {
  response.headers.emplace_back(
      "Content-Security-Policy",
      "default-src 'none'; script-src 'self'" + inline_scripts +
          "; style-src 'self'; img-src 'self' blob: data:; font-src 'self'; connect-src 'self'; "
          "worker-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'; "
          "frame-ancestors 'none'");
  response.headers.emplace_back("X-Content-Type-Options", "nosniff");
  response.headers.emplace_back("Referrer-Policy", "no-referrer");
  response.headers.emplace_back("X-Frame-Options", "DENY");
  response.headers.emplace_back("Cross-Origin-Opener-Policy", "same-origin");
  response.headers.emplace_back("Cross-Origin-Resource-Policy", "same-origin");
}

SharedScript script_member(const Json& body, std::size_t longest) {
  return {text_member(body, "name", longest_name), text_member(body, "script", longest)};
}

Json json_of(const SharedScript& shared) {
  return Json::object({{"name", shared.name}, {"script", shared.script}});
}

// "sha256-<base64>" of each inline script.
void add_inline_scripts(std::string_view page, std::set<std::string>& digests) {
  constexpr std::string_view begin = "<script>", end = "</script>";
  for (std::size_t at = 0; (at = page.find(begin, at)) != std::string_view::npos;) {
    at += begin.size();
    const std::string_view script = page.substr(at, page.find(end, at) - at);
    std::array<std::uint8_t, SHA256_DIGEST_LENGTH> digest{};
    SHA2_CTX context;
    SHA256Init(&context);
    SHA256Update(&context, reinterpret_cast<const std::uint8_t*>(script.data()), script.size());
    SHA256Final(digest.data(), &context);
    digests.insert("sha256-" + base64({reinterpret_cast<const char*>(digest.data()), digest.size()}));
  }
}

// As a gzip file (RFC 1952); "" if this saves nothing.
std::string packed(const std::string& content) {
  constexpr int with_gzip_head = MAX_WBITS + 16, most_memory = 8;
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, with_gzip_head, most_memory,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    return {};
  std::string result(content.size(), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  stream.avail_in = static_cast<uInt>(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  const bool whole = deflate(&stream, Z_FINISH) == Z_STREAM_END;
  result.resize(whole ? stream.total_out : 0);
  deflateEnd(&stream);
  return result;
}

// By Accept-Encoding (RFC 9110): listed, and not with a weight of zero.
bool takes_gzip(const HttpRequest& request) {
  const std::string* accepted = request.header("accept-encoding");
  std::istringstream codings(accepted == nullptr ? std::string() : *accepted);
  const std::string weighted = "gzip;q=";
  for (std::string coding; std::getline(codings, coding, ',');) {
    std::erase(coding, ' ');
    if (coding == "gzip") return true;
    if (coding.starts_with(weighted)) return std::strtod(coding.c_str() + weighted.size(), nullptr) > 0;
  }
  return false;
}

constexpr const char* documents_need =
    "the site of the documents is missing: `./lab docs` builds it in build/site of the source folder, and an "
    "installed program looks in share/asperity/site; start the server again after that";

}  // namespace

const char* const page_needs =
    "the page was not built: it needs npm (Debian's package npm); with it, configure and build again, "
    "`cmake --build build/release`";

PageFiles::PageFiles(const std::optional<std::filesystem::path>& folder, std::string root, std::string needs)
    : root_(std::move(root)), needs_(std::move(needs)) {
  constexpr std::size_t largest = std::size_t{32} << 20;
  if (!folder) return;
  std::int64_t bytes = 0;
  std::set<std::string> inline_scripts;
  for (const PlainFile& file : plain_files(*folder, 1000, bytes)) {
    if (file.name[0] == '.' || file.name.find("/.") != std::string::npos || file.name.ends_with(".map"))
      continue;
    auto content = read_plain_file(*folder, file.name, largest);
    if (!content) continue;
    if (file.name.ends_with(".html")) add_inline_scripts(*content, inline_scripts);
    // Weak: packed or not.
    const std::string tag = "W/\"" + Digester().add(*content).hex() + "\"";
    std::string small = packed(*content);
    files_[root_ + file.name] = {*std::move(content), std::move(small), media_type(file.name), tag};
  }
  for (const std::string& script : inline_scripts) inline_scripts_ += " '" + script + "'";
  if (!files_.contains(root_ + "index.html")) files_.clear();
}

HttpResponse PageFiles::answer(const HttpRequest& request) const {
  if (!built()) return {.status = request.path == "/" ? 503 : 404, .body = needs_ + "\n"};
  const auto found = files_.find(request.path == root_ ? root_ + "index.html" : request.path);
  if (found == files_.end()) return {.status = 404, .body = "there is no such page\n"};
  const File& file = found->second;
  HttpResponse response{
      .headers = {{"ETag", file.tag}, {"Cache-Control", "no-cache"}, {"Vary", "Accept-Encoding"}},
      .type = file.type};
  const std::string* known = request.header("if-none-match");
  if (known != nullptr && *known == file.tag) {
    response.status = 304;
    return response;
  }
  const bool small = !file.packed.empty() && takes_gzip(request);
  if (small) response.headers.emplace_back("Content-Encoding", "gzip");
  response.body = small ? file.packed : file.content;
  return response;
}

void RoomBoard::predict(std::size_t person, const std::string& lesson, const Json& guesses,
                        const std::string& why) {
  if (!guesses.is_object()) refuse("`guesses` is no object", "give numbers or choices by name");
  if (guesses.members().size() > most_guesses)
    refuse(std::to_string(guesses.members().size()) + " guesses are given",
           "give at most " + std::to_string(most_guesses));
  Prediction given{.guesses = {}, .why = why};
  for (const auto& [name, value] : guesses.members()) {
    const std::size_t longest = std::max(name.size(), value.is_string() ? value.string().size() : 0);
    if (longest > longest_name)
      refuse("a name or a choice has " + std::to_string(longest) + " bytes",
             "give at most " + std::to_string(longest_name));
    if (!value.is_string() && !(value.is_number() && std::isfinite(value.number())))
      refuse("the guess `" + name + "` is no finite number and no text", "give a number or a choice");
    given.guesses[name] = value;
  }
  const std::lock_guard lock(mutex_);
  auto& predictions = of_[person].predictions;
  if (given.guesses.empty() && why.empty()) {
    predictions.erase(lesson);
    return;
  }
  if (!predictions.contains(lesson) && predictions.size() >= most_lessons)
    refuse("there are predictions of " + std::to_string(most_lessons) + " lessons", "take some back");
  predictions[lesson] = std::move(given);
}

void RoomBoard::ask_for_help(std::size_t person, bool wanted, std::optional<SharedScript> script) {
  const std::lock_guard lock(mutex_);
  of_[person].help = wanted;
  of_[person].script = std::move(script);
}

void RoomBoard::hand(std::optional<SharedScript> script) {
  using std::chrono::milliseconds;
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const std::int64_t clock = std::chrono::duration_cast<milliseconds>(now).count();
  const std::lock_guard lock(mutex_);
  handed_ = {std::max(handed_.number + 1, clock), std::move(script)};
}

RoomBoard::Notes RoomBoard::notes_of(std::size_t person) const {
  const std::lock_guard lock(mutex_);
  const auto found = of_.find(person);
  return found == of_.end() ? Notes{} : found->second;
}

RoomBoard::Handed RoomBoard::handed() const {
  const std::lock_guard lock(mutex_);
  return handed_;
}

Api::Api(ApiSetup setup, const Access& access, RunQueue& runs, LiveSessions& live, PageFiles page,
         const std::optional<std::filesystem::path>& documents)
    : setup_(std::move(setup)),
      access_(access),
      runs_(runs),
      live_(live),
      page_(std::move(page)),
      documents_(documents, "/docs/", documents_need),
      streams_({.places = 600, .each = setup_.classroom ? 24 : 300}) {}

std::optional<HttpResponse> Api::refuse(const HttpRequest& head) {
  std::optional<HttpResponse> refused = refusal_of(head);
  if (refused) add_safe_headers(*refused);
  return refused;
}

std::optional<HttpResponse> Api::refusal_of(const HttpRequest& head) const {
  if (const std::string why = access_.misdirected(head); !why.empty()) return problem_answer(403, why);
  if (head.path.find('\0') != std::string::npos)
    return problem_answer(400, "the address holds a character that no address has");
  if (head.path.size() > 2000) return problem_answer(414, "the address is too long");
  const bool api = head.path.starts_with("/api/");
  if (api && !access_.person(head))
    return problem_answer(401, "the request carries no token that this server knows",
                          "open the whole address that `asperity serve` printed");
  const bool reads = head.method == "GET" || (head.method == "HEAD" && !api);
  if (!reads && !(api && (head.method == "POST" || head.method == "DELETE")))
    return problem_answer(405, "the method is not one of this address");
  const auto lengths = head.headers.equal_range("content-length");
  const bool has_body =
      head.headers.contains("transfer-encoding") ||
      std::any_of(lengths.first, lengths.second, [](const auto& header) { return header.second != "0"; });
  if (head.method != "POST")
    return has_body ? std::optional(problem_answer(400, "a request of this method has no body"))
                    : std::nullopt;
  const std::string* length = head.header("content-length");
  if (length == nullptr || head.headers.contains("transfer-encoding") ||
      head.headers.contains("content-encoding"))
    return problem_answer(411, "the body must come as it is, with its length");
  const std::optional<std::uint64_t> bytes = count_in(*length);
  if (!bytes) return problem_answer(400, "the length of the body is no number");
  if (*bytes > HttpSetup{}.most_body_bytes)
    return problem_answer(413, "the body has " + std::to_string(*bytes) + " bytes",
                          "a request may have " + std::to_string(HttpSetup{}.most_body_bytes));
  const std::string* type = head.header("content-type");
  if (type == nullptr || !is_json(*type))
    return problem_answer(415, "the body must be JSON, and said to be (Content-Type: application/json)");
  return {};
}

HttpResponse Api::answer(const HttpRequest& request) {
  const bool document = request.path.starts_with("/docs/");
  HttpResponse response;
  try {
    response = request.path.starts_with("/api/") ? route(request)
               : request.path == "/docs" ? HttpResponse{.status = 308, .headers = {{"Location", "/docs/"}}}
               : document                ? documents_.answer(request)
                                         : page_.answer(request);
  } catch (const Error& error) {
    const bool theirs = error.code() != ErrorCode::bad_state && error.code() != ErrorCode::internal;
    response = problem_answer(theirs ? 400 : 503, error.sentence(), error.hint());
  } catch (const std::exception& error) {
    response = problem_answer(500, error.what());
  }
  add_safe_headers(response, document ? documents_.inline_scripts() : "");
  return response;
}

HttpResponse Api::route(const HttpRequest& request) {
  const std::optional<std::size_t> person = access_.person(request);
  if (!person) return problem_answer(401, "the request carries no token that this server knows");
  const std::string path = request.path.substr(5);
  const bool get = request.method == "GET", post = request.method == "POST";
  if (path == "about" && get) return about(*person);
  if (path == "complete" && post) return complete(*person, request);
  if (path == "check" && post) return check(*person, request);
  if (path == "lessons" && get)
    return json_answer(lesson_entries(lessons_with(setup_.lessons), sees_notes(*person)));
  if (path.starts_with("lessons/") && get) return lesson(*person, path.substr(8));
  if (path == "runs" && get) return runs_of(*person);
  if (path == "room" && get && is_teacher(*person)) return room();
  if (path == "people" && get && is_teacher(*person)) return people();
  if (path.starts_with("people/") && get && is_teacher(*person)) return shown_by(path.substr(7));
  if (path == "handed" && get && setup_.classroom) return handed(request);
  if (path == "handed" && post && is_teacher(*person)) return hand(request);
  if (path == "predictions" && post && setup_.classroom) return predict(*person, request);
  if (path == "help" && post && setup_.classroom) return help(*person, request);
  if (path == "runs" && post) return begin_run(*person, request);
  if (path == "live" && post) return begin_live(*person, request);
  if (path.starts_with("live/") && !get) return of_live(*person, request, path.substr(5));
  if (path.starts_with("runs/")) {
    const auto [id, rest] = split(path.substr(5));
    const auto run = runs_.find(id);
    if (run != nullptr && (run->owner == *person || is_teacher(*person)))
      return of_run(*person, request, run, rest);
  }
  return not_there();
}

HttpResponse Api::about(std::size_t person) const {
  const RunLimits& limits = setup_.limits;
  return json_answer(Json::object({{"version", lua::version_text()},
                                   {"limits", Json::object({{"memory_bytes", limits.memory_bytes},
                                                            {"seconds", limits.seconds},
                                                            {"output_bytes", limits.output_bytes},
                                                            {"runs", setup_.at_once}})},
                                   {"classroom", setup_.classroom},
                                   {"documents", documents_.built()},
                                   {"help", board_.notes_of(person).help},
                                   {"teacher", is_teacher(person)}}));
}

HttpResponse Api::complete(std::size_t person, const HttpRequest& request) {
  const auto share = completions_.take(person, longest_wait);
  if (share == nullptr) return problem_answer(503, "other completions are being computed", "try again");
  const Json body = body_of(request);
  const std::string text = text_member(body, "text", longest_script);
  const std::int64_t position = whole_member(body, "position", 0);
  return json_answer(completion_of(text, static_cast<std::size_t>(position)));
}

HttpResponse Api::check(std::size_t person, const HttpRequest& request) {
  const std::string script = text_member(body_of(request), "script", longest_script);
  const auto share = checks_.take(person, longest_wait);
  if (share == nullptr) return problem_answer(503, "other scripts are being checked", "try again");
  return json_answer(
      check_script(script, setup_.scratch, setup_.barriers, [this] { return checks_.waiting() > 0; }));
}

// {script, tab, seed?}
HttpResponse Api::begin_live(std::size_t person, const HttpRequest& request) {
  const Json body = body_of(request);
  RunRequest asked;
  asked.script = text_member(body, "script", longest_script);
  asked.seed = whole_member(body, "seed", 1);
  const std::string tab = text_member(body, "tab", longest_name);
  return json_answer(Json::object({{"id", live_.begin(person, tab, asked)->id}}), 201);
}

// POST {knobs, view?, map?}: streams the results as frames.
HttpResponse Api::of_live(std::size_t person, const HttpRequest& request, const std::string& id) {
  if (request.method == "DELETE") {
    live_.end(person, id);
    return json_answer(Json::object({{"id", id}}));
  }
  const auto session = live_.find(person, id);
  if (session == nullptr) return problem_answer(404, "there is no such script that follows its knobs");
  const Json body = body_of(request);
  const GivenKnobs knobs = knobs_member(body, "knobs");
  const auto name_in = [&body](const char* member) {
    return body.find(member) == nullptr ? std::string() : text_member(body, member, longest_name);
  };
  const std::string view = name_in("view"), map = name_in("map");
  const auto share = streams_.take(person, std::chrono::milliseconds(0));
  if (share == nullptr) return too_many_answers();
  const std::int64_t move = live_.move(*session, knobs, view, map);
  return stream_answer("application/octet-stream", [session, move, share](std::string& piece) {
    return session->answer(move, piece, std::chrono::milliseconds(500));
  });
}

HttpResponse Api::begin_run(std::size_t person, const HttpRequest& request) {
  const Json body = body_of(request);
  RunRequest asked;
  asked.script = text_member(body, "script", longest_script);
  if (body.find("name") != nullptr) asked.name = text_member(body, "name", longest_name);
  asked.seed = whole_member(body, "seed", 1);
  asked.views = flag_member(body, "views");
  asked.knobs = knobs_member(body, "knobs");
  try {
    const auto run = runs_.add(person, std::move(asked));
    return json_answer(Json::object({{"id", run->id}}), 201);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::bad_state) throw;
    return problem_answer(429, error.sentence(), error.hint());
  }
}

HttpResponse Api::runs_of(std::size_t person) const {
  Json::List list;
  for (const auto& run : runs_.all())
    if (run->owner == person) list.push_back(facts_of(*run));
  return json_answer(list);
}

HttpResponse Api::room() const {
  Json::List list;
  for (const auto& run : runs_.all())
    list.push_back(facts_of(*run).set("owner", access_.people()[run->owner].name));
  return json_answer(list);
}

HttpResponse Api::people() const {
  Json::List list;
  for (std::size_t person = 1; person < access_.people().size(); ++person) {
    Json::List predictions, whys;
    const RoomBoard::Notes notes = board_.notes_of(person);
    for (const auto& [lesson, given] : notes.predictions) {
      for (const auto& [name, value] : given.guesses)
        predictions.push_back(Json::object({{"lesson", lesson}, {"name", name}, {"value", value}}));
      if (!given.why.empty()) whys.push_back(Json::object({{"lesson", lesson}, {"text", given.why}}));
    }
    list.push_back(Json::object({{"name", access_.people()[person].name},
                                 {"help", notes.help},
                                 {"script", notes.script.has_value()},
                                 {"predictions", std::move(predictions)},
                                 {"whys", std::move(whys)}}));
  }
  return json_answer(list);
}

// {lesson, guesses, why?}
HttpResponse Api::predict(std::size_t person, const HttpRequest& request) {
  const Json body = body_of(request);
  const Json& guesses = body["guesses"];
  const std::string why = body.find("why") != nullptr ? text_member(body, "why", RoomBoard::longest_why) : "";
  board_.predict(person, text_member(body, "lesson", RoomBoard::longest_name), guesses, why);
  return json_answer(Json::object({{"kept", guesses.members().size()}}));
}

HttpResponse Api::help(std::size_t person, const HttpRequest& request) {
  const Json body = body_of(request);
  const bool wanted = flag_member(body, "wanted");
  const bool shows = wanted && body.find("script") != nullptr;
  board_.ask_for_help(person, wanted,
                      shows ? std::optional(script_member(body, RoomBoard::most_shown)) : std::nullopt);
  return json_answer(Json::object({{"wanted", wanted}}));
}

HttpResponse Api::of_run(std::size_t person, const HttpRequest& request, const std::shared_ptr<PageRun>& run,
                         const std::string& rest) {
  if (rest.empty()) {
    if (request.method == "DELETE") runs_.stop(*run);
    return json_answer(facts_of(*run));
  }
  if (request.method != "GET") return problem_answer(405, "this can only be read");
  const auto share = streams_.take(person, std::chrono::milliseconds(0));
  if (share == nullptr) return too_many_answers();
  HttpResponse response = rest == "events"             ? events_answer(run, request)
                          : rest.starts_with("files/") ? file_answer(*run, rest.substr(6))
                          : rest.starts_with("views/") ? view_answer(*run, rest.substr(6))
                                                       : not_there();
  if (response.stream)
    response.stream = [share, next = std::move(response.stream)](std::string& piece) { return next(piece); };
  return response;
}

HttpResponse Api::lesson(std::size_t person, const std::string& name) const {
  const auto all = lessons_with(setup_.lessons);
  const auto found = std::ranges::find(all, name, &lua::Lesson::name);
  if (found == all.end() || !found->problem.empty()) return problem_answer(404, "there is no such lesson");
  return json_answer(lesson_answer(*found, sees_notes(person)));
}

// {name, script}; without a script it is taken back.
HttpResponse Api::hand(const HttpRequest& request) {
  const Json body = body_of(request);
  const bool given = body.find("script") != nullptr;
  board_.hand(given ? std::optional(script_member(body, RoomBoard::most_handed)) : std::nullopt);
  return json_answer(Json::object({{"number", board_.handed().number}}));
}

// {number}, with the script if it is newer than the query's `after`.
HttpResponse Api::handed(const HttpRequest& request) const {
  const RoomBoard::Handed now = board_.handed();
  const auto after = request.parameters.find("after");
  const bool known = after != request.parameters.end() && after->second == std::to_string(now.number);
  Json answer = now.script && !known ? json_of(*now.script) : Json::object();
  return json_answer(answer.set("number", now.number));
}

HttpResponse Api::shown_by(const std::string& name) const {
  const auto person = std::ranges::find(access_.people(), name, &Person::name);
  const auto shown = board_.notes_of(static_cast<std::size_t>(person - access_.people().begin())).script;
  return shown ? json_answer(json_of(*shown)) : problem_answer(404, "this student shows no script");
}

}  // namespace asperity::web
