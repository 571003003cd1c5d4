// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/confined/confined_command.hpp"

#include <pwd.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <utility>

#include "bindings/cli/disk_bound.hpp"
#include "bindings/cli/mpi_ranks.hpp"
#include "bindings/cli/plain_streams.hpp"
#include "bindings/cli/watchdog.hpp"
#include "bindings/web/confined/confined_process.hpp"
#include "bindings/web/sandbox/plain_files.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/require.hpp"
#include "engine/run/recorded_run.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::web {

namespace {

namespace fs = std::filesystem;

constexpr double usual_seconds = 600;
constexpr std::int64_t usual_disk = std::int64_t{1} << 30;
constexpr std::size_t most_files = 20000, most_script_bytes = std::size_t{64} << 20;

// Null if unreadable; later code reports the error.
Json manifest_in(const std::string& folder) {
  std::error_code problem;
  // Opening a pipe would block.
  if (!fs::is_regular_file(fs::path(folder) / "manifest.json", problem)) return {};
  try {
    return read_manifest(folder);
  } catch (const Error&) {
    return {};
  }
}

bool was_confined(const Json& manifest) { return manifest["confined"] == Json(true); }

void say_where_a_link_leads(const std::string& folder, const fs::path& real) {
  std::string named = folder;
  while (named.size() > 1 && named.back() == '/') named.pop_back();
  std::error_code problem;
  if (fs::is_symlink(fs::symlink_status(named, problem)))
    std::fprintf(stderr, "asperity: %s is a link to %s\n", named.c_str(), real.c_str());
}

fs::path canonical(const std::string& folder, const char* option) {
  std::error_code problem;
  const fs::path real = fs::canonical(folder.empty() ? "." : folder, problem);
  if (problem || !fs::is_directory(real, problem))
    refuse(asperity::quoted(option) + " names " + asperity::quoted(folder) + ", which is no folder",
           "give a folder that is there");
  if (real == "/") refuse(asperity::quoted(option) + " names the whole tree of files", "give a folder in it");
  say_where_a_link_leads(folder, real);
  return real;
}

bool is_at_or_above(const fs::path& folder, const fs::path& other) {
  return std::ranges::mismatch(folder, other).in1 == folder.end();
}

bool holds_the_home(const fs::path& folder) {
  const passwd* const user = ::getpwuid(::getuid());
  for (const char* named : {static_cast<const char*>(std::getenv("HOME")),
                            user != nullptr ? static_cast<const char*>(user->pw_dir) : nullptr}) {
    std::error_code problem;
    if (named == nullptr || named[0] != '/') continue;
    const fs::path home = fs::canonical(named, problem);
    if (!problem && home != "/" && is_at_or_above(folder, home)) return true;
  }
  return folder == "/";
}

// The script's folders, under their real names and their names in the command.
class Places {
 public:
  void add(const std::string& named, const fs::path& real, bool write) {
    if (const auto known = std::ranges::find(places_, real.string(), &Place::seen); known == places_.end())
      places_.push_back({real.string(), real.string(), write});
    else
      known->write = known->write || write;
    std::string seen = fs::absolute(named.empty() ? "." : named).lexically_normal().string();
    while (seen.size() > 1 && seen.back() == '/') seen.pop_back();
    if (seen != real.string()) links_.push_back({real.string(), seen, write});
  }
  std::vector<std::string> folders() const {
    std::vector<std::string> named;
    for (const Place& place : places_) named.push_back(place.seen);
    return named;
  }
  std::vector<Place> all() const {
    std::vector<Place> all = places_;
    // Links inside a place need no entry.
    for (const Place& link : links_)
      if (std::ranges::none_of(places_,
                               [&](const Place& place) { return is_at_or_above(place.seen, link.seen); }))
        all.push_back(link);
    return all;
  }

 private:
  std::vector<Place> places_, links_;
};

// The open ways that are allowed. Throws Error{not_permitted} for other open ways, Error{bad_value} for
// unknown names.
std::vector<std::string> open_ways(const BarrierReport& report, const std::string& without) {
  const std::vector<std::string> known{"files", "processes", "network", "programs"};
  std::vector<std::string> allowed;
  std::istringstream names(without);
  for (std::string name; std::getline(names, name, ',');) {
    if (name.empty()) continue;
    if (std::ranges::find(known, name) == known.end())
      refuse("`--without-barriers` names " + asperity::quoted(name) + did_you_mean(name, known),
             "the barriers are " + joined(known, " and "));
    allowed.push_back(name);
  }
  std::vector<std::string> open, refused, reasons;
  for (const std::string& name : known) {
    const auto tried = std::ranges::find(report.tried, name, &Barrier::name);
    if (tried != report.tried.end() && tried->holds) continue;
    open.push_back(name);
    if (std::ranges::find(allowed, name) != allowed.end()) continue;
    refused.push_back(name);
    reasons.push_back(name + " (" +
                      (tried != report.tried.end() ? tried->by
                       : report.problem.empty()    ? "another program could be run"
                                                   : report.problem) +
                      ")");
  }
  if (!refused.empty())
    throw Error(ErrorCode::not_permitted,
                "this system lacks barriers of `--confined`: " + joined(reasons, " and ") +
                    (report.missing.empty() ? "" : "; it has no " + joined(report.missing, " and ")),
                "use a kernel with Landlock (Linux 5.13) or user namespaces and asperity-sandbox.so, or give "
                "`--without-barriers " +
                    joined(open, ",") + "`");
  return open;
}

// Stop signals and Ctrl-Z, blocked in this thread and later threads.
Descriptor signals_to_pass_on() {
  sigset_t set = cli::stop_signals();
  struct sigaction suspend {};
  if (::sigaction(SIGTSTP, nullptr, &suspend) == 0 && suspend.sa_handler != SIG_IGN) sigaddset(&set, SIGTSTP);
  ::pthread_sigmask(SIG_BLOCK, &set, nullptr);
  return Descriptor(::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK));
}

// Follows the process of a command: passes on output and signals.
class CommandFollower final : public Follower {
 public:
  // `signals`: blocked before the process and its threads begin.
  CommandFollower(const ConfinedRequest& request, const FollowBounds& bounds, Descriptor signals)
      : Follower(request, bounds.directory.string(), bounds), signals_(std::move(signals)) {
    process_.events.reset();
    also_watched_.push_back({signals_.get(), POLLIN, 0});
  }

  // Returns the exit status.
  int carry_through() {
    std::signal(SIGPIPE, SIG_IGN);  // runs on without readers
    const int status = follow();
    std::fwrite(error_tail_.data(), 1, error_tail_.size(), stderr);
    if (const std::string removed =
            cli::keep_within(bounds_.directory, bounds_.directory_bytes, bounds_.files);
        !removed.empty())
      std::fprintf(stderr, "asperity: %s\n", removed.c_str());
    if (!ended_for_.empty()) {
      std::fprintf(stderr, "asperity: the run was ended: %s\n", ended_for_.c_str());
      return cli::failed;
    }
    if (WIFEXITED(status)) return WEXITSTATUS(status);
    std::fprintf(stderr, "asperity: %s\n", death_text(WTERMSIG(status)).c_str());
    return 128 + WTERMSIG(status);
  }

 private:
  void take(const Descriptor& from, std::string_view text) override {
    if (&from == &process_.error) return pass_on_errors(text);
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
  }

  void look(Clock::time_point) override {
    for (signalfd_siginfo met{}; ::read(signals_.get(), &met, sizeof met) == sizeof met;) {
      const int signal = static_cast<int>(met.ssi_signo);
      process_.send(signal == SIGTSTP ? SIGSTOP : signal);
      if (signal != SIGTSTP) continue;
      ::raise(SIGSTOP);
      process_.send(SIGCONT);
    }
  }

  // Only progress lines may overwrite themselves.
  void pass_on_errors(std::string_view text) {
    if (::isatty(STDERR_FILENO) == 0) {
      std::fwrite(text.data(), 1, text.size(), stderr);
      return;
    }
    const std::string_view erase = cli::erase_line;
    std::string all = std::exchange(error_tail_, "") + std::string(text);
    std::size_t begin = 0;
    for (std::size_t at; (at = all.find(erase, begin)) != std::string::npos; begin = at + erase.size()) {
      std::fwrite(all.data() + begin, 1, at - begin, stderr);
      cli::erase_shown_line();
    }
    std::size_t end = all.size();
    for (std::size_t k = 1; k < erase.size() && begin + k <= all.size(); ++k)
      if (all.ends_with(erase.substr(0, k)) && process_.error.get() >= 0) end = all.size() - k;
    error_tail_ = all.substr(end);
    std::fwrite(all.data() + begin, 1, end - begin, stderr);
  }

  Descriptor signals_;
  std::string error_tail_;
};

class Undertaking {
 public:
  Undertaking(cli::RunCommand run, const cli::ReplayCommand* replay)
      : run_(std::move(run)), replay_(replay) {}

  int carry_through() {
    check_options();
    if (replay_ != nullptr) take_record(replay_->recorded, "replay");
    // First: a refused run stays as it is.
    if (run_.resume) refuse_links(*run_.resume);
    if (run_.resume) take_record(*run_.resume, "go on with");
    if (!run_.script.empty()) read_script();
    for (const std::string& folder : run_.read) {
      read_.push_back(canonical(folder, "--read").string());
      places_.add(folder, read_.back(), false);
    }
    check_recorded_folders();
    for (const std::string& folder : run_.reuse) places_.add(folder, canonical(folder, "--reuse"), false);

    BarrierReport report;
    {
      const TemporaryFolder trial("barriers");
      report = try_out_barriers(trial.path().string());
    }
    const std::vector<std::string> open = open_ways(report, run_.without_barriers);
    if (!open.empty())
      std::fprintf(stderr, "asperity: without barriers for %s\n", joined(open, " and ").c_str());
    run_.barriers = Json::object({{"read", Json::strings(read_)},
                                  {"by", Json::strings(report.made)},
                                  {"missing", Json::strings(report.missing)},
                                  {"open", Json::strings(open)}});
    make_folders();
    const auto before = manifest_text();
    const int status = follow(report.made);
    keep_on_record(before);
    if (status == cli::failed)
      std::fprintf(stderr,
                   "asperity: a confined script finds no files but those in %s; --read FOLDER adds more\n",
                   joined(places_.folders(), " and ").c_str());
    return status;
  }

  ~Undertaking() {
    try {
      prepared_.leave();
    } catch (const std::exception&) {
    }
  }
  Undertaking(const Undertaking&) = delete;
  Undertaking& operator=(const Undertaking&) = delete;

 private:
  void check_options() const {
    if (run_.trust) refuse("`--trust` and `--confined` exclude each other", "leave one of them out");
    if (cli::launched_rank(run_.shard.has_value()))
      refuse("a confined run was started as one of the ranks of mpirun",
             "start it alone, or share the cases of ensembles by `--shard` and `--store`");
  }

  // A foreign record grants no access to files.
  void take_record(const std::string& folder, const char* purpose) {
    const Json manifest = manifest_in(folder);
    if (manifest.is_null()) return;
    purpose_ = purpose;
    if (const Json& read = manifest["unhashed"]["barriers"]["read"]; !read.is_null())
      for (const Json& place : read.list()) recorded_.push_back(place.string());
    if (replay_ != nullptr) places_.add(folder, canonical(folder, "replay"), false);
  }

  // The run directory publishes a copy of the script with the results.
  void read_script() {
    const fs::path given(run_.script);
    run_.text = cli::read_script(run_.script);
    const fs::path real = fs::canonical(given);
    if (!is_at_or_above(canonical(given.parent_path().string(), "script"), real))
      throw Error(ErrorCode::not_permitted,
                  "the confined script " + asperity::quoted(run_.script) + " is a link to " + real.string(),
                  "name the file itself");
  }

  void check_recorded_folders() const {
    std::string missing;
    for (const std::string& folder : recorded_)
      if (std::ranges::find(read_, folder) == read_.end())
        missing += (missing.empty() ? "" : " ") + ("--read " + folder);
    if (missing.empty()) return;
    refuse("the run was recorded with `" + missing + "`",
           std::string("add it to ") + purpose_ + " the run so");
  }

  // Made and locked here: this process outlives the child and removes files beyond the limits.
  void make_folders() {
    RunSetup setup;
    setup.script_name = run_.script.empty() ? "replay" : run_.script;
    const Json manifest = replay_ == nullptr ? Json() : manifest_in(replay_->recorded);
    if (const Json& name = manifest["script"]["name"]; !name.is_null()) setup.script_name = name.string();
    if (run_.out) setup.out = *run_.out;
    if (run_.resume) setup.resume = *run_.resume;
    prepared_ = RunDirectory::prepared_for(setup);
    if (!run_.resume) run_.out = prepared_.path.string();
    directory_ = canonical(prepared_.path.string(), run_.resume ? "--resume" : "--out");
    places_.add(prepared_.path.string(), directory_, true);
    keep_out_of_home(directory_, run_.resume ? "--resume" : "--out");
    if (prepared_.lock && !prepared_.lock->notice().empty())
      std::fprintf(stderr, "asperity: %s\n", prepared_.lock->notice().c_str());
    if (run_.store) {
      std::error_code problem;
      fs::create_directories(*run_.store, problem);
      if (problem) throw_file_error("make the folder", *run_.store, problem.value());
      const fs::path store = canonical(*run_.store, "--store");
      keep_out_of_home(store, "--store");
      places_.add(*run_.store, store, true);
    }
  }

  static void keep_out_of_home(const fs::path& folder, const char* option) {
    if (holds_the_home(folder))
      throw Error(ErrorCode::not_permitted,
                  "a confined script writes into the folder of " + asperity::quoted(option) +
                      ", and this one holds your home folder: " + folder.string(),
                  "give a folder of its own");
  }

  int follow(const std::vector<std::string>& barriers) {
    const FollowBounds bounds{.seconds = run_.limit_time.value_or(usual_seconds),
                              .directory = directory_,
                              .directory_bytes = run_.limit_disk.value_or(usual_disk),
                              .files = most_files,
                              .disk_option = " (--limit-disk)"};
    run_.limit_time = bounds.seconds;
    run_.limit_disk = bounds.directory_bytes;
    run_.limit_memory =
        run_.limit_memory.value_or(std::max(memory::of_machine() / 2, std::int64_t{256} << 20));
    // Stored results count in the directory's limit.
    if (!run_.store)
      run_.store_limit =
          std::min(run_.store_limit.value_or(bounds.directory_bytes), bounds.directory_bytes / 2);
    const int threads = run_.threads > 0 ? run_.threads : thread_count();
    run_.threads = threads;
    run_.terminal = ::isatty(STDERR_FILENO) != 0;

    ConfinedRequest request{.work = Work::command, .confinement = {}};
    Confinement& held = request.confinement;
    held.places = places_.all();
    held.work = fs::current_path().string();
    held.memory_bytes = *run_.limit_memory;
    held.file_bytes = bounds.directory_bytes;
    held.threads = request.threads = threads;
    held.processor_seconds = static_cast<std::int64_t>(bounds.seconds + 5) * threads + 1;
    request.barriers = barriers;
    request.command = {run_, replay_ == nullptr ? std::nullopt : std::optional(*replay_)};
    if (prepared_.lock) request.lock = prepared_.lock->descriptor();
    return CommandFollower(request, bounds, signals_to_pass_on()).carry_through();
  }

  std::optional<std::string> manifest_text() const {
    return read_plain_file(directory_, "manifest.json", most_script_bytes);
  }

  // A script that escaped Lua could rewrite its manifest and be repeated without barriers.
  void keep_on_record(const std::optional<std::string>& before) const {
    std::error_code problem;
    const fs::path file = directory_ / "manifest.json";
    if (!fs::exists(fs::symlink_status(file, problem))) return;
    const auto now = manifest_text();
    if (now && (now == before || was_confined(manifest_in(directory_)))) return;
    fs::remove(file, problem);
    std::fprintf(
        stderr,
        "asperity: the manifest of %s no longer said that the run was confined, and was removed: this "
        "is no record that can be trusted\n",
        directory_.c_str());
  }

  cli::RunCommand run_;
  const cli::ReplayCommand* replay_;  // null for a run
  Places places_;
  std::vector<std::string> read_, recorded_;  // from --read; from the record
  std::string purpose_;
  RunDirectory::Prepared prepared_;
  fs::path directory_;  // without links
};

}  // namespace

bool to_be_confined(const cli::RunCommand& command) {
  return command.confined || (command.resume && was_confined(manifest_in(*command.resume)));
}

bool to_be_confined(const cli::ReplayCommand& command) {
  return command.run.confined || was_confined(manifest_in(command.recorded));
}

int run_behind_barriers(const cli::RunCommand& command) {
  return Undertaking(command, nullptr).carry_through();
}

int replay_behind_barriers(const cli::ReplayCommand& command) {
  return Undertaking(command.run, &command).carry_through();
}

int carry_out(CarriedCommand command, int lock) {
  cli::make_errors_plain();
  std::setvbuf(stdout, nullptr, _IOLBF, std::size_t{1} << 14);
  cli::RunCommand& run = command.run;
  if (lock >= 0) run.lock = RunLock::inherited(run.resume ? *run.resume : run.out.value_or("."), lock);
  if (!command.replay) return cli::run(run);
  command.replay->run = run;
  return cli::replay(*command.replay);
}

}  // namespace asperity::web
