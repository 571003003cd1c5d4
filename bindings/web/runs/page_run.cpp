// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/runs/page_run.hpp"

#include <sys/stat.h>

#include <cerrno>

#include "bindings/web/confined/disk_bound.hpp"
#include "bindings/web/runs/run_follower.hpp"
#include "bindings/web/sandbox/plain_files.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/disk.hpp"

namespace asperity::web {

namespace {

const char* kind_of(const std::string& name) {
  const auto ends = [&](const char* ending) { return name.ends_with(ending); };
  if (ends(".csv")) return "table";
  if (ends(".svg") || ends(".png")) return "picture";
  if (ends(".h5") || ends(".hdf5") || ends(".npy")) return "field";
  return "file";
}

// Records of every run; hidden and temporary files.
bool is_own(const std::string& name) {
  return name == "script.lua" || name == "manifest.json" || name == "journal.jsonl" || name[0] == '.' ||
         name.find("/.") != std::string::npos || name.starts_with("store/");
}

std::filesystem::path made(const std::filesystem::path& folder) {
  if (::mkdir(folder.c_str(), 0700) != 0) throw_file_error("make the folder", folder, errno);
  return folder;
}

}  // namespace

const char* name(RunState state) {
  switch (state) {
    case RunState::waiting:
      return "waiting";
    case RunState::running:
      return "running";
    case RunState::done:
      return "done";
    case RunState::failed:
      return "failed";
    case RunState::stopped:
      return "stopped";
    case RunState::limit:
      return "limit";
  }
  return "";
}

PageRun::PageRun(std::string name, std::size_t of, RunRequest asked, const std::filesystem::path& in)
    : id(std::move(name)),
      owner(of),
      request(std::move(asked)),
      folder(made(in)),
      directory(made(in / "run")),
      events(in / "events.jsonl") {}

void PageRun::stop() { stop_.store(true); }

void PageRun::go(const RunLimits& limits, const std::vector<std::string>& barriers) {
  begun_ = std::chrono::steady_clock::now();
  state_.store(RunState::running);
  events.add("started", Json::object());
  try {
    RunFollower follower(*this, limits, barriers);
    follower.follow();
    processor_seconds_ = follower.processor_seconds();
    const std::string removed = keep_within(directory, limits.directory_bytes, limits.files);
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

void PageRun::give_up(RunState state, const std::string& reason) { finish(state, 1, reason); }

void PageRun::finish(RunState state, int exit, const std::string& reason) {
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begun_;
  Json fields = Json::object({{"status", name(state)}, {"exit", exit}, {"seconds", seconds.count()}});
  if (!reason.empty()) fields.set("reason", reason);
  // First the state: a reader of the last event must find the run ended.
  state_.store(state);
  events.finish(fields);
}

void PageRun::tell_files(bool last) {
  std::int64_t bytes = 0;
  for (const PlainFile& file : plain_files(directory, 5000, bytes)) {
    Known& known = files_.try_emplace(file.name, Known{-1, 0, false}).first->second;
    const bool same = known.bytes == file.bytes && known.changed == file.changed;
    if (!same) known = {file.bytes, file.changed, false};
    // Announced when size and time stop changing.
    if (known.told || !(same || last) || is_own(file.name)) continue;
    known.told = true;
    events.add("file",
               Json::object({{"name", file.name}, {"bytes", file.bytes}, {"kind", kind_of(file.name)}}));
  }
  directory_bytes_.store(bytes);
}

}  // namespace asperity::web
