// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/serve_command.hpp"

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
#include <memory>
#include <thread>

#include "bindings/cli/commands/shared_options.hpp"
#include "bindings/cli/exit_status.hpp"
#include "bindings/web/api/api.hpp"
#include "bindings/web/confined/barrier_report.hpp"
#include "bindings/web/places.hpp"
#include "bindings/web/sandbox/frames.hpp"
#include "bindings/web/serve_setup.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/loaded_part.hpp"

extern char** environ;

namespace asperity::web {

namespace {

constexpr const char* open_page = "open.html";
constexpr int usual_port = 8137;  // browsers store edits by address and port

// Api needs the port for the allowed Host values.
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
    throw Error(
        ErrorCode::bad_value,
        "port " + std::to_string(setup.port) + " of " + setup.address + " cannot be listened on: " + problem,
        command.classroom.empty() ? "give another with --port, or none"
                                  : "give an address of this machine, and a port that is free");
  return server;
}

// Through a page that redirects: the address contains the token, and every user can read program arguments.
void open_in_browser(const std::string& url, const std::filesystem::path& folder) {
  const std::filesystem::path page = folder / open_page;
  const int file = ::open(page.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
  const bool written =
      file >= 0 && write_all(file,
                             "<!DOCTYPE html><meta charset=\"utf-8\"><title>Asperity</title><meta "
                             "name=\"referrer\" content=\"no-referrer\"><meta http-equiv=\"refresh\" "
                             "content=\"0; url=" +
                                 url + "\"><p><a href=\"" + url + "\">Asperity</a></p>\n") == 0;
  if (file >= 0) ::close(file);
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

void print_addresses(const ServeCommand& command, const Access& access, int port) {
  const std::string begin = "http://" + shown_address(command) + ":" + std::to_string(port) + "/#";
  std::size_t widest = 0;
  for (const Person& person : access.people()) widest = std::max(widest, person.name.size());
  if (command.classroom.empty()) {
    std::printf("%s%s\n", begin.c_str(), access.people()[0].token.c_str());
  } else {
    std::printf(
        "one address for each; it is a key, and what follows the # is not sent over the network by "
        "itself\n\n");
    for (const Person& person : access.people())
      std::printf("%-*s  %s%s\n", static_cast<int>(widest), person.name.c_str(), begin.c_str(),
                  person.token.c_str());
    std::printf("\n");
  }
  std::fflush(stdout);
}

// Before any thread, which inherits the mask.
sigset_t block_stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

void wait_for_end(const sigset_t& signals) {
  int signal = 0;
  while (::sigwait(&signals, &signal) != 0) {
  }
}

// Removes `folder` without recorded runs; names it otherwise.
void clean_up(const std::filesystem::path& folder, const std::filesystem::path& scratch) {
  std::error_code ignored;
  std::filesystem::remove_all(scratch, ignored);
  std::filesystem::remove(folder / open_page, ignored);
  if (std::filesystem::is_empty(folder, ignored))
    std::filesystem::remove(folder, ignored);
  else
    std::fprintf(stderr, "what the runs recorded is in %s\n", folder.c_str());
}

int serve_until_stopped(const ServeCommand& command) {
  const sigset_t signals = block_stop_signals();
  std::signal(SIGPIPE, SIG_IGN);
  allow_many_files();

  const std::vector<Person> people = people_of(command);
  QueueSetup queue = queue_of(command);
  LateHandler handler;
  const std::unique_ptr<HttpServer> server = listen(command, handler);
  queue.folder = session_folder(command);
  const std::filesystem::path scratch = queue.folder / "scratch", folder = queue.folder;
  if (::mkdir(scratch.c_str(), 0700) != 0) throw_file_error("make the folder", scratch, errno);

  const BarrierReport barriers = try_out_barriers(scratch.string());
  if (!command.classroom.empty() && !barriers.all_hold()) {
    std::filesystem::remove_all(folder);
    throw Error(
        ErrorCode::not_permitted,
        "this machine does not keep the scripts of others in:\n" + barriers.text() + "a room is not served",
        "a kernel with Landlock (Linux 5.13) or user namespaces, and the part asperity-sandbox.so, would");
  }
  queue.barriers = barriers.made;
  const int at_once = queue.at_once;
  const RunLimits limits = queue.limits;
  const Access access(hosts_of(command, server->port()), people);
  const auto pages = shared_folder("page", "page");
  const PageFiles page(pages);
  RunQueue runs(std::move(queue));
  const bool room = !command.classroom.empty();
  LiveSessions live({scratch, limits, barriers.made, at_once, room ? people.size() : 16, room ? 2U : 8U});
  handler.api = std::make_unique<Api>(ApiSetup{limits, at_once, room, barriers.made, scratch}, access, runs,
                                      live, page);

  std::thread answering([&] { server->serve(); });
  print_addresses(command, access, server->port());
  if (!page.built()) std::fprintf(stderr, "asperity: %s; until then /api is served alone\n", page_needs);
  std::fprintf(stderr, "runs are kept in %s; %d at once, each at most %.0f s and %.0f MiB\n", folder.c_str(),
               at_once, limits.seconds, static_cast<double>(limits.memory_bytes) / 0x1p20);
  std::fprintf(stderr, "what a run cannot do here:\n%sCtrl-C ends it\n", barriers.text().c_str());
  if (!barriers.all_hold())
    std::fprintf(
        stderr,
        "asperity: run no script of others on this machine; your own are held by the language's limits\n");
  if (command.open)
    open_in_browser(
        "http://" + shown_address(command) + ":" + std::to_string(server->port()) + "/#" + people[0].token,
        folder);

  wait_for_end(signals);
  std::fprintf(stderr, "\nstopping\n");
  runs.close();
  live.close();
  server->stop();
  answering.join();
  clean_up(folder, scratch);
  return 0;
}

cli::CommandReader declare_serve(CLI::App& options) {
  struct Given {
    ServeCommand serve;
    std::string time, memory;
  };
  const auto given = std::make_shared<Given>();
  ServeCommand& asked = given->serve;
  options.add_option("--port", asked.port, "of the address (default 8137, or any where that is taken)")
      ->check(CLI::Range(1, 65535));
  options.add_flag("--open", asked.open, "open the page in this machine's browser");
  options.add_option("--out", asked.out,
                     "where its runs are kept (default runs/serve-<n>); must be new or empty");
  options
      .add_option("--runs", asked.runs, "scripts that run at once (default 2; in a room one per processor)")
      ->check(CLI::Range(1, 256));
  options.add_option("--limit-time", given->time, "of one run (default 10 min; in a room 60 s)");
  options.add_option("--limit-memory", given->memory,
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

  return [given]() -> cli::CommandWork {
    given->serve.limit_time = cli::seconds_of(given->time);
    given->serve.limit_memory = cli::bytes_of(given->memory);
    return [given] { return web::serve(given->serve); };
  };
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

int serve(const ServeCommand& command) {
  try {
    return serve_until_stopped(command);
  } catch (const std::exception& error) {
    return cli::refused(error);
  }
}

}  // namespace asperity::web
