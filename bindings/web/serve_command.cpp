// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/serve_command.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <set>
#include <thread>

#include "bindings/cli/commands/shared_options.hpp"
#include "bindings/cli/watchdog.hpp"
#include "bindings/web/api/api.hpp"
#include "bindings/web/api/lesson_folder.hpp"
#include "bindings/web/confined/confined_process.hpp"
#include "bindings/web/sandbox/frames.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/loaded_part.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/require.hpp"

extern char** environ;

namespace asperity::web {

namespace {

namespace fs = std::filesystem;

constexpr const char* open_page = "open.html";
constexpr int usual_port = 8137;  // fixed: browsers store edits by address

constexpr int most_students = 400;

struct ServeCommand {
  int port = 0;                              // 0: any free port
  bool open = false;                         // in this machine's browser
  std::string classroom;                     // "": this machine only
  int students = 0;                          // number
  std::string names;                         // one name a line
  std::string lessons;                       // a folder; "": those of the program
  std::string out;                           // "": runs/serve-<n>
  int runs = 0;                              // 0: by machine
  std::optional<double> limit_time;          // seconds for a run
  std::optional<std::int64_t> limit_memory;  // bytes for a run
};

bool is_v6(const std::string& address) {
  in6_addr parsed{};
  return ::inet_pton(AF_INET6, address.c_str(), &parsed) == 1;
}

void check_address(const std::string& address) {
  in_addr v4{};
  if (::inet_pton(AF_INET, address.c_str(), &v4) != 1 && !is_v6(address))
    refuse(
        "`--classroom` names " + asperity::quoted(address) + ", which is no address",
        "give the address this machine has in the room, such as 192.168.1.20 (`ip -brief address` shows it)");
  if (address == "0.0.0.0" || address == "::")
    refuse("`--classroom` names " + asperity::quoted(address) + ", which is every network at once",
           "give the one address this machine has in the room");
}

std::vector<std::string> names_in(const std::string& path) {
  std::ifstream file(path);
  if (!file)
    refuse_bad_file("there is no file " + asperity::quoted(path) + " that can be read",
                    "give the students' names in it, one per line");
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (std::string line; std::getline(file, line);) {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (line.empty()) continue;
    if (!seen.insert(line).second)
      refuse_bad_file(asperity::quoted(path) + " names " + asperity::quoted(line) + " twice");
    names.push_back(plain_text(line));
  }
  return names;
}

// Owner and students. Throws Error{bad_value} or Error{bad_file}.
std::vector<Person> people_of(const ServeCommand& command) {
  std::vector<std::string> names;
  if (command.classroom.empty()) {
    if (command.students > 0 || !command.names.empty())
      refuse("students were named and no room",
             "add --classroom ADDRESS, the address this machine has there");
    return {{"you", new_token()}};
  }
  check_address(command.classroom);
  names.emplace_back("teacher");
  if (!command.names.empty())
    for (std::string& name : names_in(command.names)) names.push_back(std::move(name));
  else
    for (int k = 1; k <= command.students; ++k) names.push_back("student " + std::to_string(k));
  if (names.size() == 1)
    refuse("a room was named and no students", "add --students 30, or --names FILE, one name a line");
  if (names.size() > most_students + 1)
    refuse(std::to_string(names.size() - 1) + " students were named",
           "at most " + std::to_string(most_students) + " can be served together");
  std::vector<Person> people;
  for (std::string& name : names) people.push_back({std::move(name), new_token()});
  return people;
}

// Without folder and barriers.
QueueSetup queue_of(const ServeCommand& command) {
  const bool room = !command.classroom.empty();
  const int processors = thread_count();
  QueueSetup setup;
  setup.shared = room;
  setup.at_once = command.runs > 0 ? command.runs : room ? processors : 2;
  setup.most_waiting_of_one = room ? 20 : 500;
  setup.most_bytes_of_one = (room ? std::int64_t{1} : std::int64_t{8}) << 30;
  RunLimits& limits = setup.limits;
  limits.threads = room ? 1 : processors;
  limits.seconds = command.limit_time.value_or(room ? 60 : 600);
  const std::int64_t share = memory::of_machine() / 2 / setup.at_once, least = std::int64_t{256} << 20;
  limits.memory_bytes = command.limit_memory.value_or(
      std::clamp(share, least, (room ? std::int64_t{1} : std::int64_t{8}) << 30));
  limits.directory_bytes = (room ? std::int64_t{64} : std::int64_t{1024}) << 20;
  return setup;
}

// runs/serve-<n>, or the named empty folder.
fs::path session_folder(const ServeCommand& command) {
  std::error_code problem;
  if (!command.out.empty()) {
    fs::create_directories(command.out, problem);
    if (problem) throw_file_error("make the folder", command.out, problem.value());
    if (!fs::is_empty(command.out, problem) || problem)
      refuse("`--out` names " + asperity::quoted(command.out) + ", which is not empty", "give a new folder");
    if (::chmod(command.out.c_str(), 0700) != 0)
      throw_file_error("restrict to yourself the folder", command.out, errno);
    return fs::canonical(command.out);
  }
  fs::create_directories("runs", problem);
  if (problem) throw_file_error("make the folder", "runs", problem.value());
  for (int n = 1;; ++n) {
    const fs::path folder = fs::path("runs") / ("serve-" + std::to_string(n));
    if (::mkdir(folder.c_str(), 0700) == 0) return fs::canonical(folder);
    if (errno != EEXIST) throw_file_error("make the folder", folder, errno);
  }
}

// Absolute, or empty. Prints the faults of its lessons.
fs::path lesson_folder(const ServeCommand& command) {
  if (command.lessons.empty()) return {};
  std::error_code problem;
  const fs::path folder = fs::canonical(command.lessons, problem);
  if (problem || !fs::is_directory(folder, problem))
    refuse_bad_file("`--lessons` names " + asperity::quoted(command.lessons) + ", which is no folder",
                    "give a folder with lessons, files such as 01_tilt.lua");
  for (const lua::Lesson& lesson : lessons_with(folder))
    if (!lesson.problem.empty()) std::fprintf(stderr, "asperity: %s\n", plain_text(lesson.problem).c_str());
  return folder;
}

// In URL form.
std::string shown_address(const ServeCommand& command) {
  if (command.classroom.empty()) return "127.0.0.1";
  return is_v6(command.classroom) ? "[" + command.classroom + "]" : command.classroom;
}

std::vector<std::string> hosts_of(const ServeCommand& command, int port) {
  std::vector<std::string> names{shown_address(command)};
  if (command.classroom.empty()) names.emplace_back("localhost");
  std::vector<std::string> hosts;
  for (const std::string& name : names) {
    hosts.push_back(name + ":" + std::to_string(port));
    if (port == 80) hosts.push_back(name);
  }
  return hosts;
}

// The first existing: share/asperity/<installed> next to an installation's bin, <build>/<built>,
// <sources>/<built>.
std::optional<fs::path> shared_folder(const std::string& installed, const std::string& built) {
  std::error_code problem;
  const fs::path own = fs::canonical("/proc/self/exe", problem).parent_path();
  if (problem) return {};
  std::vector<fs::path> places{(own / "../share/asperity" / installed).lexically_normal()};
  if (fs::canonical(ASPERITY_BUILD_FOLDER, problem) == own && !problem) {
    places.push_back(own / built);
    places.push_back(fs::path(ASPERITY_SOURCE_FOLDER) / built);
  }
  for (const fs::path& place : places)
    if (fs::is_directory(place, problem)) return place;
  return {};
}

// Api needs the port for its Host values.
class LateHandler final : public HttpHandler {
 public:
  std::unique_ptr<Api> api;
  std::optional<HttpResponse> refuse(const HttpRequest& head) override { return api->refuse(head); }
  HttpResponse answer(const HttpRequest& request) override { return api->answer(request); }
};

std::unique_ptr<HttpServer> listen(const ServeCommand& command, HttpHandler& handler) {
  auto* const make = part_function<MakeHttpServer>({"serve", "pages are served", "libcpp-httplib0.11"},
                                                   "asperity_http_server");
  HttpSetup setup;
  setup.address = command.classroom.empty() ? "127.0.0.1" : command.classroom;
  setup.port = command.port == 0 ? usual_port : command.port;
  setup.most_connections = command.classroom.empty() ? 400 : 800;
  std::string problem;
  std::unique_ptr<HttpServer> server(make(setup, handler, problem));
  if (server == nullptr && command.port == 0) {
    setup.port = 0;
    server.reset(make(setup, handler, problem));
  }
  if (server == nullptr)
    refuse(
        "port " + std::to_string(setup.port) + " of " + setup.address + " cannot be listened on: " + problem,
        command.classroom.empty() ? "give another with --port, or none"
                                  : "give an address of this machine, and a port that is free");
  return server;
}

// Through a page that redirects: the address contains the token, and program arguments are public.
void open_in_browser(const std::string& url, const fs::path& folder) {
  const fs::path page = folder / open_page;
  const ScopedFile file(::open(page.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
  const bool written =
      file.number >= 0 && write_all(file.number,
                                    "<!DOCTYPE html><meta charset=\"utf-8\"><title>Asperity</title><meta "
                                    "name=\"referrer\" content=\"no-referrer\"><meta http-equiv=\"refresh\" "
                                    "content=\"0; url=" +
                                        url + "\"><p><a href=\"" + url + "\">Asperity</a></p>\n") == 0;
  if (!written) {
    std::fprintf(stderr, "asperity: %s cannot be written; open the address above\n", page.c_str());
    return;
  }
  char program[] = "xdg-open";
  std::string address = page.string();
  char* const arguments[] = {program, address.data(), nullptr};
  pid_t child = 0;
  if (::posix_spawnp(&child, program, nullptr, nullptr, arguments, environ) != 0)
    std::fprintf(stderr,
                 "asperity: no browser could be opened (xdg-open is not there); open the address above\n");
}

void allow_many_files() {
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) != 0) return;
  files.rlim_cur = std::min<rlim_t>(files.rlim_max, 16384);
  ::setrlimit(RLIMIT_NOFILE, &files);
}

// `begin`: of each address, before the token.
void print_addresses(const std::string& begin, const std::vector<Person>& people, bool room) {
  std::size_t widest = 0;
  for (const Person& person : people) widest = std::max(widest, person.name.size());
  if (!room) {
    std::printf("%s%s\n", begin.c_str(), people[0].token.c_str());
  } else {
    std::printf(
        "one address for each; it is a key, and the part after the # is not sent over the network by "
        "itself\n\n");
    for (const Person& person : people)
      std::printf("%-*s  %s%s\n", static_cast<int>(widest), person.name.c_str(), begin.c_str(),
                  person.token.c_str());
    std::printf("\n");
  }
  std::fflush(stdout);
}

// Removes `folder` without recorded runs, or names it.
void clean_up(const fs::path& folder, const fs::path& scratch) {
  std::error_code ignored;
  fs::remove_all(scratch, ignored);
  fs::remove(folder / open_page, ignored);
  if (fs::is_empty(folder, ignored))
    fs::remove(folder, ignored);
  else
    std::fprintf(stderr, "the records of the runs are in %s\n", folder.c_str());
}

int serve(const ServeCommand& command) {
  const sigset_t& signals = cli::stop_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);  // threads inherit the mask
  std::signal(SIGPIPE, SIG_IGN);
  allow_many_files();

  const std::vector<Person> people = people_of(command);
  const fs::path lessons = lesson_folder(command);
  QueueSetup queue = queue_of(command);
  LateHandler handler;
  const std::unique_ptr<HttpServer> server = listen(command, handler);
  queue.folder = session_folder(command);
  const fs::path scratch = queue.folder / "scratch", folder = queue.folder;
  private_folder(scratch);

  const BarrierReport barriers = try_out_barriers(scratch.string());
  if (!command.classroom.empty() && !barriers.all_hold()) {
    fs::remove_all(folder);
    throw Error(
        ErrorCode::not_permitted,
        "this machine cannot confine the scripts of others:\n" + barriers.text() + "a room is not served",
        "use a kernel with Landlock (Linux 5.13) or user namespaces, and asperity-sandbox.so");
  }
  queue.barriers = barriers.made;
  const int at_once = queue.at_once;
  const RunLimits limits = queue.limits;
  const Access access(hosts_of(command, server->port()), people);
  const auto pages = shared_folder("page", "page");
  const PageFiles page(pages, "/", page_needs);
  RunQueue runs(std::move(queue));
  const bool room = !command.classroom.empty();
  LiveSessions live({scratch, limits, barriers.made, at_once, room ? people.size() : 16, room ? 2U : 8U});
  handler.api = std::make_unique<Api>(ApiSetup{limits, at_once, room, barriers.made, scratch, lessons},
                                      access, runs, live, page, shared_folder("site", "build/site"));

  std::thread answering([&] { server->serve(); });
  const std::string begin = "http://" + shown_address(command) + ":" + std::to_string(server->port()) + "/#";
  print_addresses(begin, people, room);
  if (!page.built()) std::fprintf(stderr, "asperity: %s; until then /api is served alone\n", page_needs);
  std::fprintf(stderr, "runs are stored in %s; %d at once, each at most %.0f s and %.0f MiB\n",
               folder.c_str(), at_once, limits.seconds, static_cast<double>(limits.memory_bytes) / 0x1p20);
  std::fprintf(stderr, "what a run cannot do here:\n%sCtrl-C ends it\n", barriers.text().c_str());
  if (!barriers.all_hold())
    std::fprintf(
        stderr,
        "asperity: run no script of others on this machine; your own are held by the language's limits\n");
  if (command.open) open_in_browser(begin + people[0].token, folder);

  int signal = 0;
  while (::sigwait(&signals, &signal) != 0) {
  }
  std::fprintf(stderr, "\nstopping\n");
  runs.close();
  live.close();
  server->stop();
  answering.join();
  clean_up(folder, scratch);
  return 0;
}

cli::CommandReader declare_serve(CLI::App& options) {
  const auto given = std::make_shared<ServeCommand>();
  ServeCommand& asked = *given;
  options.add_option("--port", asked.port, "of the address (default 8137, or any where that is taken)")
      ->check(CLI::Range(1, 65535));
  options.add_flag("--open", asked.open, "open the page in this machine's browser");
  options.add_option("--lessons", asked.lessons,
                     "a folder of your own lessons, before those of the program; read at each request");
  options.add_option("--out", asked.out,
                     "where its runs are kept (default runs/serve-<n>); must be new or empty");
  options
      .add_option("--runs", asked.runs, "scripts that run at once (default 2; in a room one per processor)")
      ->check(CLI::Range(1, 256));
  cli::add_seconds(options, "--limit-time", asked.limit_time, "of one run (default 10 min; in a room 60 s)");
  cli::add_bytes(options, "--limit-memory", asked.limit_memory, "a memory limit",
                 "of one run (default: its share of half the machine's)");
  CLI::Option* room = options.add_option("--classroom", asked.classroom,
                                         "serve a room on this address of the machine, with a key for each "
                                         "student; without it only this machine is");
  CLI::Option* students =
      options.add_option("--students", asked.students, "of the room")->check(CLI::Range(1, 400))->needs(room);
  options.add_option("--names", asked.names, "a file of the students' names, one per line")
      ->needs(room)
      ->excludes(students);
  options.footer(
      "Each run is a process of its own that reaches no other file, process or network; what holds it on "
      "this machine is tried and shown at the start.");

  return [given]() -> cli::CommandWork { return [given] { return serve(*given); }; };
}

}  // namespace

cli::Command serve_command() {
  return {
      .name = "serve",
      .sentence = "open the laboratory as a page: an editor, runs, charts and lessons in a browser",
      .overview =
          "asperity serve [options]                       open the laboratory as a page, for one or for a "
          "room\n",
      .declare = declare_serve};
}

}  // namespace asperity::web
