// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/confined/confined.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <utility>

#include "bindings/cli/commands/run_command.hpp"
#include "bindings/cli/exit_status.hpp"
#include "bindings/web/confined/command_request.hpp"
#include "bindings/web/confined/confined_command.hpp"
#include "bindings/web/confined/drawing.hpp"
#include "bindings/web/confined/event_channel.hpp"
#include "bindings/web/confined/live_script.hpp"
#include "bindings/web/sandbox/system_calls.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/loaded_part.hpp"
#include "engine/core/text.hpp"
#include "engine/run/run_facts.hpp"

namespace asperity::web {

namespace {

constexpr std::array<const char*, 6> works{"run", "check", "draw", "probe", "command", "live"};

const Json& request_member(const Json& json, const char* name) {
  const Json* found = json.find(name);
  if (found == nullptr) throw Error(ErrorCode::bad_file, "the request has no " + asperity::quoted(name));
  return *found;
}

std::int64_t whole(const Json& json, const char* name) {
  return static_cast<std::int64_t>(request_member(json, name).number());
}

Json to_json(const Place& place) {
  return Json::object(
      {{"folder", characters_of(place.folder)}, {"seen", characters_of(place.seen)}, {"write", place.write}});
}

std::string standard_input() {
  std::string text;
  char piece[65536];
  for (ssize_t got = 0; (got = ::read(STDIN_FILENO, piece, sizeof piece)) != 0;) {
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) break;
    text.append(piece, static_cast<std::size_t>(got));
  }
  return text;
}

// Loads everything that the barriers hide later; a missing part is an error at its first use.
void prepare_run() {
  machine_facts();
  find_own_place();
  try {
    part_symbol({"hdf5", "HDF5 files are written", "libhdf5-103-1"}, "asperity_hdf5_write_1");
  } catch (const Error&) {
  }
}

int print_probe(const std::vector<std::string>& made, const std::vector<std::string>& missing) {
  Json::List barriers;
  for (const Barrier& barrier : try_barriers()) {
    barriers.push_back(Json::object({{"name", barrier.name},
                                     {"sentence", barrier.sentence},
                                     {"holds", barrier.holds},
                                     {"by", barrier.by}}));
    // After each attempt: a failing barrier may end this process.
    const Json all = Json::object(
        {{"made", Json::strings(made)}, {"missing", Json::strings(missing)}, {"barriers", barriers}});
    std::printf("%s\n", all.text().c_str());
    std::fflush(stdout);
  }
  return 0;
}

int become_gnuplot() {
  char program[] = "gnuplot", settings[] = "-d", script[] = "script";
  char path[] = "PATH=/usr/bin:/bin", language[] = "LC_ALL=C.UTF-8";
  char* const arguments[] = {program, settings, script, nullptr};
  char* const environment[] = {path, language, nullptr};
  ::execve("/usr/bin/gnuplot", arguments, environment);
  std::fprintf(stderr, "gnuplot cannot be started: %s\n", std::strerror(errno));
  return 127;
}

int run_or_check(const ConfinedRequest& request) {
  EventChannel events(events_descriptor, request.views ? ".views" : "");
  cli::RunCommand command;
  command.script = request.name;
  command.text = request.script;
  command.out = ".";
  command.threads = request.threads;
  command.seed = static_cast<std::uint64_t>(request.seed);
  command.knobs = request.knobs;
  command.limit_memory = request.confinement.memory_bytes;
  command.limit_time = request.seconds;
  command.limit_disk = request.confinement.file_bytes;
  command.store_limit = 0;
  command.observer = &events;
  std::setvbuf(stdout, nullptr, _IOLBF, std::size_t{1} << 14);
  if (request.work == Work::check) return cli::check(command);
  draw_by_server(drawing_descriptor);
  return cli::run(command);
}

}  // namespace

Json to_json(const ConfinedRequest& request) {
  const Confinement& c = request.confinement;
  Json::List places;
  for (const Place& place : c.places) places.push_back(to_json(place));
  return Json::object({{"work", works.at(static_cast<std::size_t>(request.work))},
                       {"drawing", c.as == Confined::drawing},
                       {"memory_bytes", c.memory_bytes},
                       {"file_bytes", c.file_bytes},
                       {"processor_seconds", c.processor_seconds},
                       {"parent", static_cast<std::int64_t>(::getpid())},
                       {"script", request.script},
                       {"name", request.name},
                       {"seed", request.seed},
                       {"seconds", request.seconds},
                       {"threads", request.threads},
                       {"views", request.views},
                       {"knobs", knobs_json(request.knobs)},
                       {"barriers", Json::strings(request.barriers)},
                       {"places", std::move(places)},
                       {"work_folder", characters_of(c.work)},
                       {"command", request.command},
                       {"locked", request.lock >= 0}});
}

ConfinedRequest confined_request(const Json& json) {
  ConfinedRequest request;
  const std::string& work = request_member(json, "work").string();
  const auto known = std::ranges::find(works, work);
  if (known == works.end()) throw Error(ErrorCode::bad_file, "the request is to " + asperity::quoted(work));
  request.work = static_cast<Work>(known - works.begin());
  request.confinement.as = request_member(json, "drawing").boolean() ? Confined::drawing : Confined::script;
  request.confinement.memory_bytes = whole(json, "memory_bytes");
  request.confinement.file_bytes = whole(json, "file_bytes");
  request.confinement.processor_seconds = whole(json, "processor_seconds");
  if (json.find("parent") != nullptr) request.confinement.parent = whole(json, "parent");
  request.script = request_member(json, "script").string();
  request.name = request_member(json, "name").string();
  request.seed = whole(json, "seed");
  request.seconds = request_member(json, "seconds").number();
  request.threads = static_cast<int>(whole(json, "threads"));
  request.confinement.threads = request.threads;
  request.views = request_member(json, "views").boolean();
  for (const Json& barrier : request_member(json, "barriers").list())
    request.barriers.push_back(barrier.string());
  if (json.find("knobs") != nullptr) request.knobs = knobs_in(json, "knobs");
  if (const Json* places = json.find("places"))
    for (const Json& place : places->list())
      request.confinement.places.push_back({bytes_of(request_member(place, "folder").string()),
                                            bytes_of(request_member(place, "seen").string()),
                                            request_member(place, "write").boolean()});
  if (const Json* folder = json.find("work_folder")) request.confinement.work = bytes_of(folder->string());
  if (const Json* command = json.find("command")) request.command = *command;
  if (const Json* locked = json.find("locked"); locked != nullptr && locked->boolean())
    request.lock = lock_descriptor;
  return request;
}

int confined_main() {
  std::signal(SIGPIPE, SIG_IGN);
  try {
    const ConfinedRequest request = confined_request(Json::parse(standard_input(), "the request"));
    if (const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC); nothing >= 0) {
      ::dup2(nothing, STDIN_FILENO);
      ::close(nothing);
    }
    load_system_call_filter();
    if (request.work == Work::run || request.work == Work::command || request.work == Work::live)
      prepare_run();
    std::vector<std::string> missing;
    const std::vector<std::string> made = confine(request.confinement, missing);
    for (const std::string& barrier : request.barriers)
      if (std::ranges::find(made, barrier) == made.end())
        throw Error(ErrorCode::bad_state,
                    "the run was not begun: " + asperity::quoted(barrier) + " could not be put up",
                    joined(missing, ", "));
    switch (request.work) {
      case Work::probe:
        return print_probe(made, missing);
      case Work::draw:
        return become_gnuplot();
      case Work::run:
      case Work::check:
        return run_or_check(request);
      case Work::live:
        return run_as_knobs_move(request, drawing_descriptor);
      case Work::command:
        draw_by_server(drawing_descriptor);
        return carry_out(request.command, request.lock);
    }
  } catch (const std::exception& error) {
    return cli::refused(error);
  }
  return cli::failed;
}

}  // namespace asperity::web
