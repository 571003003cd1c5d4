// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/run_directory.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "engine/core/digest.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/text.hpp"
#include "engine/run/recorded_run.hpp"
#include "engine/run/run_facts.hpp"

namespace asperity {

namespace fs = std::filesystem;

namespace {
std::pair<std::uint64_t, std::uint64_t> place_of(const fs::path& folder) {
  struct ::stat facts {};
  if (::stat(folder.c_str(), &facts) != 0) return {};
  return {facts.st_dev, facts.st_ino};
}
}  // namespace

void RunDirectory::require_place() const {
  if (!root_.empty() && place_of(root_) != place_)
    throw Error(ErrorCode::bad_file,
                quoted(root_.string()) + " was moved or removed while the run wrote there",
                "go on with --resume where it is now");
}

std::string_view name(RunStatus status) {
  switch (status) {
    case RunStatus::running:
      return "running";
    case RunStatus::done:
      return "done";
    case RunStatus::shard:
      return "shard";
    case RunStatus::failed:
      return "failed";
    case RunStatus::interrupted:
      return "interrupted";
    case RunStatus::killed:
      return "killed";
  }
  return "unknown";
}

RunDirectory::RunDirectory(const RunSetup& setup) : trusted_(setup.trusted) { make(setup); }

RunDirectory::RunDirectory(RunSetup setup, std::function<std::string()> text)
    : trusted_(setup.trusted),
      journal_(std::make_unique<Journal>()),
      later_(std::move(setup)),
      text_(std::move(text)) {}

RunDirectory::Prepared RunDirectory::prepared_for(const RunSetup& setup) {
  Prepared prepared;
  std::error_code reason;
  std::vector<fs::path> holding;
  if (setup.resume) {
    prepared.path = *setup.resume;
    prepared.made = !fs::exists(prepared.path, reason);
    holding = make_folders(prepared.path);
    const bool is_run =
        is_not_begun(prepared.path) || fs::exists(prepared.path / run_names::manifest, reason);
    if (is_run && ::access(prepared.path.c_str(), W_OK) == 0) prepared.lock = RunLock::take(prepared.path);
  } else if (setup.out) {
    prepared.made = !fs::exists(*setup.out, reason);
    prepared.path = given_directory(*setup.out, prepared.lock, true, holding);
  } else {
    prepared.made = true;
    prepared.path = numbered_directory(setup.runs, setup.script_name, holding);
    prepared.lock = RunLock::take(prepared.path);
  }
  // The other process may have no access to these folders.
  for (const fs::path& folder : holding) wait_for_names_in(folder);
  return prepared;
}

void RunDirectory::Prepared::leave() {
  std::error_code ignored;
  const auto is_lock = [](const fs::path& file) { return file.filename() == RunLock::file_name; };
  if (made && is_not_begun(path) && std::ranges::all_of(entries_of(path), is_lock)) {
    fs::remove(path / RunLock::file_name, ignored);
    fs::remove(path, ignored);
  }
  if (lock) lock->release();
  lock = nullptr;
}

void RunDirectory::make(const RunSetup& setup) {
  lock_ = setup.lock;
  scratch_ = setup.scratch;
  // Independent of the working directory.
  root_ = fs::absolute(setup.resume ? *setup.resume
                       : setup.out  ? given_directory(*setup.out, lock_, !scratch_, holding_)
                                    : numbered_directory(setup.runs, setup.script_name, holding_))
              .lexically_normal();
  if (lock_ == nullptr && !scratch_) lock_ = RunLock::take(root_);
  if (setup.resume) {
    refuse_links(root_);
    // Parts of killed writers: no other process writes here.
    sweep_parts(root_, Parts::all, true);
  }
  if (setup.resume && setup.anew) move_aside(root_);
  begin(setup);
}

RunDirectory::RunDirectory(Without kind, bool trusted)
    : kind_(kind == Without::dry ? Kind::dry : Kind::loose),
      trusted_(trusted),
      journal_(std::make_unique<Journal>()) {}

RunDirectory::~RunDirectory() = default;

std::vector<fs::path> RunDirectory::needed_to_resume() const {
  if (kind_ != Kind::directory || later_) return {};
  return {root_ / run_names::script, root_ / run_names::manifest, root_};
}

void RunDirectory::begin(const RunSetup& setup) {
  place_ = place_of(root_);
  script_text_ = setup.script_text;
  const bool again = setup.resume && !setup.anew;
  const Durable durable = scratch_ ? Durable::no : Durable::yes;
  if (again && setup.journal_lost) {
    std::error_code missing;
    fs::remove(root_ / run_names::journal, missing);
  }
  journal_ = again && !setup.journal_lost ? Journal::again(root_ / run_names::journal)
                                          : std::make_unique<Journal>(root_ / run_names::journal);
  if (!again) write_atomically(root_ / run_names::script, setup.script_text, durable);
  const std::string digest = Digester().add(setup.script_text).hex();
  const std::string script = fs::path(setup.script_name).filename().string();
  manifest_.set("status", name(RunStatus::running))
      .set("versions", setup.versions)
      .set("script", Json::object({{"name", script}, {"digest", digest}}))
      .set("arguments", Json::strings(setup.arguments))
      .set("seed", setup.seed)
      .set("trusted", setup.trusted);
  if (!setup.knobs.is_null()) manifest_.set("knobs", setup.knobs);
  if (!setup.barriers.is_null()) {
    manifest_.set("confined", true);
    unhashed_.set("barriers", setup.barriers);
  }
  unhashed_.set("started", utc_now())
      .set("directory", root_.string())
      .set("script_path", setup.script_name)
      .set("threads", setup.threads)
      .set("machine", machine_facts());
  if (!setup.store.empty()) unhashed_.set("store", fs::absolute(setup.store).lexically_normal().string());
  if (!setup.shard.empty()) unhashed_.set("shard", setup.shard);
  if (again) take_up();
  journal_->write("begin", Json::object({{"script", script}, {"digest", digest}, {"seed", setup.seed}}));
  // Sufficient for a resume after a power cut.
  write_manifest(durable);
  if (scratch_) return;
  wait_for_disk(root_);
  for (const fs::path& folder : holding_) wait_for_names_in(folder);
}

// Keeps earlier dates.
void RunDirectory::take_up() {
  const Json earlier = read_manifest(root_);
  const Json* kept = earlier.find("unhashed");
  Json::List dates;
  if (kept != nullptr) {
    if (const Json* known = kept->find("resumed")) dates = known->list();
    if (const Json* started = kept->find("started")) unhashed_.set("started", *started);
  }
  dates.push_back(utc_now());
  unhashed_.set("resumed", std::move(dates));
  // Expected outputs stay recorded until the mending succeeds.
  const Json* status = earlier.find("status");
  if (status != nullptr && *status == Json(name(RunStatus::done))) {
    if (const Json* outputs = earlier.find("outputs")) recorded_outputs_ = *outputs;
  } else if (kept != nullptr) {
    if (const Json* outputs = kept->find(mending_member)) recorded_outputs_ = *outputs;
  }
  if (!recorded_outputs_.is_null()) unhashed_.set(mending_member, recorded_outputs_);
  const Json* read = earlier.find("inputs");
  if (read == nullptr && kept != nullptr) read = kept->find(run_names::inputs_so_far);
  if (read == nullptr) return;
  for (const Json& entry : read->list()) {
    const Json *file = entry.find("file"), *digest = entry.find("digest");
    if (file != nullptr && digest != nullptr) recorded_inputs_.emplace_back(file->string(), digest->string());
  }
}

void RunDirectory::write_manifest(Durable durable) {
  Json whole = manifest_, unhashed = unhashed_;
  if (!finished_ && !inputs_.empty()) unhashed.set(run_names::inputs_so_far, inputs());
  whole.set("unhashed", std::move(unhashed));
  write_atomically(root_ / run_names::manifest, whole.text(2) + "\n", durable);
}

void RunDirectory::note(std::string_view key, Json value) {
  const std::lock_guard lock(mutex_);
  manifest_.set(key, std::move(value));
}

void RunDirectory::note_unhashed(std::string_view key, Json value) {
  const std::lock_guard lock(mutex_);
  unhashed_.set(key, std::move(value));
}

Json RunDirectory::inputs() const {
  Json::List list;
  for (const Input& input : inputs_) {
    Json entry = Json::object({{"file", input.file}, {"bytes", input.bytes}, {"digest", input.digest}});
    if (!input.copy.empty()) entry.set("copy", input.copy);
    list.push_back(std::move(entry));
  }
  return list;
}

std::string RunDirectory::own_name(const fs::path& place) const {
  const fs::path inside = root_.empty() ? "" : place.lexically_relative(root_);
  return inside.empty() || *inside.begin() == ".." ? "" : inside.string();
}

void RunDirectory::note_loaded(std::string_view file, const std::string& text) {
  const std::string digest = content_digest(text);
  // Named by content: names may lead out, and files may change.
  const std::string copy = std::string(run_names::loaded) + "/" +
                           safe_file_name(fs::path(std::string(file)).stem().string()) + "-" +
                           digest.substr(0, 12) + ".lua";
  const bool recorded = kind_ == Kind::directory && !later_;
  std::error_code missing;
  if (recorded && !scratch_ && fs::file_size(root_ / copy, missing) != text.size()) {
    make_folders(root_ / run_names::loaded);
    write_atomically(root_ / copy, text);
  }
  note_input(file, static_cast<std::int64_t>(text.size()), digest, recorded ? copy : "");
}

bool RunDirectory::note_input(std::string_view file, std::int64_t bytes, std::string_view digest,
                              const std::string& copy) {
  const std::lock_guard lock(mutex_);
  const bool is_new = inputs_.insert({std::string(file), bytes, std::string(digest), copy}).second;
  // A rewrite for every input would cost n².
  const bool due = (is_new && !copy.empty()) || inputs_.size() > inputs_on_disk_ + inputs_on_disk_ / 8;
  if (due && kind_ == Kind::directory && !later_ && !scratch_ && !finished_) {
    try {
      inputs_on_disk_ = inputs_.size();
      write_manifest(Durable::no);
    } catch (const Error&) {  // finish() reports an unwritable manifest
    }
  }
  return std::ranges::any_of(
      recorded_inputs_, [&](const auto& known) { return known.first == file && known.second != digest; });
}

}  // namespace asperity
