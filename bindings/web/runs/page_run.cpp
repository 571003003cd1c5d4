// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/runs/page_run.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>

#include "bindings/cli/disk_bound.hpp"
#include "bindings/web/sandbox/frames.hpp"
#include "bindings/web/sandbox/plain_files.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/text.hpp"

namespace asperity::web {

namespace {

constexpr auto tell_every = std::chrono::milliseconds(300);
constexpr std::int64_t longest_event = std::int64_t{1} << 20;

// Records of every run; hidden and temporary files.
bool is_own(const std::string& name) {
  return name == "script.lua" || name == "manifest.json" || name == "journal.jsonl" || name[0] == '.' ||
         name.find("/.") != std::string::npos || name.starts_with("store/");
}

}  // namespace

ConfinedRequest confined_request(Work work, const RunRequest& asked, const RunLimits& limits,
                                 const std::vector<std::string>& barriers) {
  constexpr std::int64_t grace_seconds = 4, moves_of_a_session = 20;  // least processor time, in moves
  const auto seconds = static_cast<std::int64_t>(limits.seconds);
  ConfinedRequest request{.work = work, .confinement = {}};
  request.confinement.memory_bytes = limits.memory_bytes;
  request.confinement.file_bytes = limits.directory_bytes;
  request.confinement.processor_seconds =
      (work == Work::live ? moves_of_a_session * (seconds + 1) : seconds + grace_seconds) *
          std::max(1, limits.threads) +
      1;
  request.script = asked.script;
  request.seed = asked.seed;
  request.seconds = limits.seconds;
  request.threads = limits.threads;
  request.views = asked.views;
  request.knobs = asked.knobs;
  request.barriers = barriers;
  return request;
}

std::filesystem::path private_folder(const std::filesystem::path& folder) {
  if (::mkdir(folder.c_str(), 0700) != 0) throw_file_error("make the folder", folder, errno);
  return folder;
}

const char* name(RunState state) {
  constexpr std::array<const char*, 6> names{"waiting", "running", "done", "failed", "stopped", "limit"};
  return names.at(static_cast<std::size_t>(state));
}

bool EventLog::append(const std::string& type, const Json& fields) {
  if (finished_) return false;
  if (writer_.get() < 0)
    writer_ = Descriptor(::open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600));
  Json event = Json::object({{"n", static_cast<std::int64_t>(ends_.size()) + 1}, {"type", type}});
  for (const auto& [name, value] : fields.members())
    if (name != "n" && name != "type") event.set(name, value);
  const std::string line = event.text() + "\n";
  const std::int64_t begin = ends_.empty() ? 0 : ends_.back();
  if (writer_.get() < 0 || write_all(writer_.get(), line) != 0) {
    if (writer_.get() >= 0 && ::ftruncate(writer_.get(), begin) != 0) finished_ = true;
    return false;
  }
  ends_.push_back(begin + static_cast<std::int64_t>(line.size()));
  changed_.notify_all();
  return true;
}

bool EventLog::add(const std::string& type, const Json& fields) {
  const std::lock_guard lock(mutex_);
  return append(type, fields);
}

void EventLog::finish(const Json& fields) {
  const std::lock_guard lock(mutex_);
  append("finished", fields);
  finished_ = true;
  writer_.reset();
  changed_.notify_all();
}

std::string EventLog::after(std::int64_t& after, std::chrono::milliseconds patience, bool& more) const {
  constexpr std::int64_t piece = std::int64_t{64} << 10;
  std::int64_t begin = 0, end = 0;
  {
    std::unique_lock lock(mutex_);
    const auto known = [&] { return static_cast<std::int64_t>(ends_.size()); };
    changed_.wait_for(lock, patience, [&] { return finished_ || known() > after; });
    after = std::max<std::int64_t>(after, 0);
    if (known() > after) {
      begin = after == 0 ? 0 : ends_[static_cast<std::size_t>(after) - 1];
      end = ends_[static_cast<std::size_t>(after)];
      for (++after; after < known() && ends_[static_cast<std::size_t>(after)] - begin <= piece; ++after)
        end = ends_[static_cast<std::size_t>(after)];
    }
    more = !(finished_ && after >= known());
  }
  std::string text(static_cast<std::size_t>(end - begin), '\0');
  if (text.empty()) return text;
  const Descriptor reader(::open(file_.c_str(), O_RDONLY | O_CLOEXEC));
  if (reader.get() < 0 || ::lseek(reader.get(), begin, SEEK_SET) < 0 ||
      !read_whole(reader.get(), text.data(), text.size())) {
    more = false;
    return {};
  }
  return text;
}

std::int64_t EventLog::bytes() const {
  const std::lock_guard lock(mutex_);
  return ends_.empty() ? 0 : ends_.back();
}

// Stores output and events of a run, and judges its end.
class RunFollower final : public Follower {
 public:
  RunFollower(PageRun& run, const RunLimits& limits, const std::vector<std::string>& barriers)
      : Follower(confined_request(Work::run, run.request, limits, barriers), run.directory.string(),
                 {.seconds = limits.seconds,
                  .directory = run.directory,
                  .directory_bytes = limits.directory_bytes,
                  .files = limits.files}),
        run_(run),
        limits_(limits) {}

  // After the end and all output.
  void follow_to_end() {
    const int status = follow();
    watch_limits(Clock::now());
    judge(status);
  }

  RunState state = RunState::failed;
  int exit = 1;
  std::string reason;
  double processor_seconds() const { return process_.processor_seconds(); }

 private:
  void take(const Descriptor& from, std::string_view piece) override {
    if (&from == &process_.events)
      take_events(piece);
    else if (&from == &process_.output)
      take_output(piece, out_tail_, "out");
    else
      take_output(piece, error_tail_, "err");
  }

  void take_output(std::string_view piece, std::string& unfinished, const char* stream) {
    if (printed_ >= limits_.output_bytes) return;  // so that the run can end
    printed_ += static_cast<std::int64_t>(piece.size());
    std::string text = std::move(unfinished);
    text += piece;
    const std::size_t whole = text.size() - unfinished_bytes(text);
    unfinished = text.substr(whole);
    text.resize(whole);
    if (!text.empty()) run_.events.add("output", Json::object({{"stream", stream}, {"text", text}}));
    if (printed_ < limits_.output_bytes) return;
    discards_ = true;
    run_.events.add("output",
                    Json::object({{"stream", "err"},
                                  {"text", "\nit printed more than " + format_bytes(limits_.output_bytes) +
                                               ": the rest is not shown\n"}}));
  }

  void take_events(std::string_view piece) {
    line_ += piece;
    std::size_t begin = 0;
    for (std::size_t end_of_line; (end_of_line = line_.find('\n', begin)) != std::string::npos;
         begin = end_of_line + 1)
      take_event(line_.substr(begin, end_of_line - begin));
    line_.erase(0, begin);
    if (line_.size() > longest_event) {
      line_.clear();
      end("one of its rows is longer than " + format_bytes(longest_event));
    }
    if (run_.events.bytes() > limits_.event_bytes) {
      end("its rows take more than " + format_bytes(limits_.event_bytes));
      process_.events.reset();
    }
  }

  void take_event(const std::string& line) {
    constexpr std::array<std::string_view, 8> told{"progress",    "row",   "view",  "views_left_out",
                                                   "expectation", "error", "chart", "study"};
    try {
      const Json event = Json::parse(line, "an event");
      const std::string& type = event["type"].string();
      if (type == "ended") {
        if (const Json* stopped = event.find("stopped")) stopped_ = stopped->string();
        if (const Json* why = event.find("why")) why_ = why->string().substr(0, 2000);
      } else if (std::ranges::find(told, type) != told.end()) {
        run_.events.add(type, event);
      }
    } catch (const Error&) {
    }
  }

  void look(Clock::time_point now) override {
    if (run_.stop_asked() && end("it was stopped")) ended_as_ = RunState::stopped;
    if (now - told_ < tell_every) return;
    told_ = now;
    run_.tell_files(false);
  }

  void judge(int status) {
    exit = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (!ended_for_.empty()) {
      state = ended_as_;
      reason = ended_for_;
    } else if (stopped_ == "time" || stopped_ == "memory") {
      state = RunState::limit;
      reason = why_;
    } else if (WIFSIGNALED(status)) {
      const int signal = WTERMSIG(status);
      state = signal == SIGXCPU || signal == SIGKILL ? RunState::limit : RunState::failed;
      reason = death_text(signal);
    } else {
      state = exit == 0 ? RunState::done : RunState::failed;
      reason = why_;
    }
  }

  PageRun& run_;
  const RunLimits& limits_;
  std::string out_tail_, error_tail_, line_;
  std::int64_t printed_ = 0;
  Clock::time_point told_{};
  RunState ended_as_ = RunState::limit;  // by the server
  std::string stopped_, why_;            // given by the process
};

PageRun::PageRun(std::string name, std::size_t of, RunRequest asked, const std::filesystem::path& in)
    : id(std::move(name)),
      owner(of),
      request(std::move(asked)),
      folder(private_folder(in)),
      directory(private_folder(in / "run")),
      events(in / "events.jsonl") {}

void PageRun::go(const RunLimits& limits, const std::vector<std::string>& barriers) {
  begun_ = std::chrono::steady_clock::now();
  state_.store(RunState::running);
  events.add("started", Json::object());
  try {
    RunFollower follower(*this, limits, barriers);
    follower.follow_to_end();
    processor_seconds_ = follower.processor_seconds();
    const std::string removed = cli::keep_within(directory, limits.directory_bytes, limits.files);
    tell_files(true);
    finish(follower.state, follower.exit,
           removed.empty() ? follower.reason
                           : follower.reason + (follower.reason.empty() ? "" : "; ") + removed);
  } catch (const std::exception& error) {
    events.add("error", Json::object({{"message", error.what()}}));
    finish(RunState::failed, 1, error.what());
  }
}

void PageRun::tell_place(std::size_t before) {
  if (state_.load() != RunState::waiting || told_place_ == before) return;
  told_place_ = before;
  events.add("waiting", Json::object({{"before", before}}));
}

void PageRun::finish(RunState state, int exit, const std::string& reason) {
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begun_;
  Json fields = Json::object({{"status", name(state)}, {"exit", exit}, {"seconds", seconds.count()}});
  if (!reason.empty()) fields.set("reason", reason);
  // First: a reader of the last event must find the run ended.
  state_.store(state);
  events.finish(fields);
}

void PageRun::tell_files(bool last) {
  std::int64_t bytes = 0;
  for (const PlainFile& file : plain_files(directory, 5000, bytes)) {
    Known& known = files_.try_emplace(file.name, Known{-1, 0, false}).first->second;
    const bool same = known.bytes == file.bytes && known.changed == file.changed;
    if (!same) known = {file.bytes, file.changed, false};
    // After size and time stop changing.
    if (known.told || !(same || last) || is_own(file.name)) continue;
    known.told = true;
    events.add("file", Json::object({{"name", file.name}, {"bytes", file.bytes}}));
  }
  directory_bytes_.store(bytes);
}

}  // namespace asperity::web
