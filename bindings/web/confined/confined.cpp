// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <iterator>
#include <mutex>

#include "bindings/cli/commands/run_command.hpp"
#include "bindings/web/confined/confined_command.hpp"
#include "bindings/web/confined/event_channel.hpp"
#include "bindings/web/confined/live_script.hpp"
#include "bindings/web/sandbox/frames.hpp"
#include "bindings/web/sandbox/plain_files.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/loaded_part.hpp"
#include "engine/core/text.hpp"
#include "engine/plot/gnuplot.hpp"
#include "engine/run/run_facts.hpp"

namespace asperity::web {

namespace {

// Loads files before barriers hide them; a missing part is an error at its first use.
void prepare_run() {
  machine_facts();
  find_own_place();
  try {
    part_symbol({"hdf5", "HDF5 files are written", "libhdf5-103-1"}, "asperity_hdf5_write_2");
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
    // Each time: a failing barrier may end this process.
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

// A confined run can start no program: the server draws (Follower).
GnuplotResult drawn_by_server(std::string_view script, std::span<const GnuplotData> data) {
  static std::mutex one_at_a_time;
  std::vector<std::string_view> texts{script};
  for (const GnuplotData& item : data) texts.insert(texts.end(), {item.name, item.bytes});
  const std::lock_guard lock(one_at_a_time);
  const bool sent = send_frame(drawing_descriptor, texts);
  const auto answer = sent ? receive_frame(drawing_descriptor, most_picture_bytes) : std::nullopt;
  if (!answer || answer->size() != 3)
    refuse_state("the picture was not drawn: the server that draws it gave no answer",
                 "a picture may have at most 64 MiB of data");
  if (!(*answer)[0].empty()) refuse_state((*answer)[0]);
  return {(*answer)[1], (*answer)[2]};
}

int run_or_check(const ConfinedRequest& request) {
  EventChannel events([](const std::string& line) { write_all(events_descriptor, line); },
                      request.views ? ".views" : "");
  const cli::RunCommand command = page_command(request, events);
  std::setvbuf(stdout, nullptr, _IOLBF, std::size_t{1} << 14);
  if (request.work == Work::check) return cli::check(command);
  draw_pictures_by(drawn_by_server);
  return cli::run(command);
}

}  // namespace

int confined_main() {
  std::signal(SIGPIPE, SIG_IGN);
  try {
    const ConfinedRequest request = confined_request(
        Json::parse(std::string(std::istreambuf_iterator<char>(std::cin), {}), "the request"));
    if (const Descriptor nothing(::open("/dev/null", O_RDONLY | O_CLOEXEC)); nothing.get() >= 0)
      ::dup2(nothing.get(), STDIN_FILENO);
    load_system_call_filter();
    if (request.work == Work::run || request.work == Work::command || request.work == Work::live)
      prepare_run();
    std::vector<std::string> missing;
    const std::vector<std::string> made = confine(request.confinement, missing);
    for (const std::string& barrier : request.barriers)
      if (std::ranges::find(made, barrier) == made.end())
        refuse_state("the run was not begun: the barrier " + asperity::quoted(barrier) + " failed",
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
        draw_pictures_by(drawn_by_server);
        return carry_out(request.command.value(), request.lock);
    }
  } catch (const std::exception& error) {
    return cli::refused(error);
  }
  return cli::failed;
}

}  // namespace asperity::web
