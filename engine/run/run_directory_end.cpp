// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <exception>

#include "engine/core/error.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/text.hpp"
#include "engine/run/run_directory.hpp"
#include "engine/run/run_facts.hpp"

namespace asperity {

namespace fs = std::filesystem;

// Content, and names up to the run's folder.
void RunDirectory::wait_for_outputs(const Json& outputs) const {
  std::set<fs::path> folders = {root_};
  std::set<std::string> files;
  for (const Json& entry : outputs.list()) files.insert(entry.find("file")->string());
  for (const Input& input : inputs_)
    if (!input.copy.empty()) files.insert(input.copy);
  for (const std::string& file : files) {
    const fs::path place = (root_ / file).lexically_normal();
    std::error_code gone;
    if (!fs::is_regular_file(place, gone)) continue;
    wait_for_disk(place);
    fs::path folder = place.parent_path();
    folders.insert(folder);
    while (std::ranges::mismatch(root_, folder).in1 == root_.end() && folder != root_)
      folders.insert(folder = folder.parent_path());
  }
  for (const fs::path& folder : folders) wait_for_names_in(folder);
  for (const fs::path& folder : holding_) wait_for_names_in(folder);
}

void RunDirectory::require_recorded(const Json& outputs) const {
  if (recorded_outputs_.is_null()) return;
  std::vector<std::string> unlike;
  const auto file_of = [](const Json& entry) { return entry.find("file")->string(); };
  for (const Json& entry : recorded_outputs_.list()) {
    const Json::List& now = outputs.list();
    const auto found =
        std::ranges::find_if(now, [&](const Json& other) { return file_of(other) == file_of(entry); });
    if (found == now.end() || !(*found == entry)) unlike.push_back(quoted(file_of(entry)));
  }
  if (!unlike.empty())
    refuse_state(joined(unlike, " and ") + " could not be restored as recorded",
                 "the script or its inputs have changed");
}

// Restores the script for a resume.
void RunDirectory::require_own_files() const {
  const fs::path script = root_ / run_names::script;
  std::error_code missing;
  if (!text_ && (!fs::is_regular_file(script, missing) || text_of_run_file(script) != script_text_)) {
    write_atomically(script, script_text_, Durable::yes);
    refuse_bad_file(quoted(script.string()) + " was altered or removed during the run, and is written again",
                    "resume the run with --resume");
  }
  if (journal_->is_altered())
    refuse_bad_file(quoted(journal_->path().string()) + " was altered by others while the run wrote it",
                    "its results are stored: resume the run with --resume");
}

// A trusted script may remove files.
void RunDirectory::require_present() const {
  std::vector<std::string> gone;
  std::error_code missing;
  const auto look = [&](const std::string& file) {
    if (!fs::exists(root_ / file, missing)) gone.push_back(quoted(file));
  };
  for (const std::string& file : outputs_)
    if (!trusted_ && !unseen_.contains(file)) look(file);
  for (const Input& input : inputs_)
    if (!input.copy.empty() && !scratch_) look(input.copy);
  if (!gone.empty())
    refuse_bad_file(joined(gone, " and ") + (gone.size() > 1 ? " were" : " was") + " removed during the run",
                    "resume the run with --resume, which writes it again");
  if (journal_->is_lost())
    refuse_bad_file(quoted(journal_->path().string()) + " was removed while the run wrote it",
                    "its results are stored: resume the run with --resume");
}

Json RunDirectory::outputs(bool with_digests) const {
  Json::List list;
  for (const std::string& file : outputs_) {
    const fs::path place = root_ / file;  // absolute: replaces the root
    std::error_code missing;
    const auto bytes = fs::file_size(place, missing);
    if (missing) continue;
    Json entry = Json::object({{"file", file}, {"bytes", bytes}});
    if (with_digests) entry.set("digest", file_digest(place));
    list.push_back(std::move(entry));
  }
  return list;
}

void RunDirectory::note_end(RunStatus status, std::string_view reason, Json files) {
  if (text_) {
    const std::string text = text_();
    write_atomically(root_ / run_names::script, text, Durable::yes);
    const Json* script = manifest_.find("script");
    Json whole = script == nullptr ? Json::object() : *script;
    manifest_.set("script", std::move(whole.set("digest", Digester().add(text).hex())));
  }
  manifest_.set("status", name(status));
  if (!reason.empty()) manifest_.set("reason", reason);
  manifest_.set("inputs", inputs()).set("outputs", std::move(files));
  if (status != RunStatus::killed && !journal_->is_lost())
    if (const std::optional<JournalFacts> facts = journal_->facts())
      manifest_.set("journal", Json::object({{"lines", facts->lines}, {"digest", facts->digest}}));
  Json::List verdicts;
  for (const Verdict& verdict : expectations_.verdicts()) verdicts.push_back(to_json(verdict));
  manifest_.set("expectations", std::move(verdicts));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - started_;
  unhashed_.set("finished", utc_now()).set("seconds", seconds.count());
  // A confined run cannot start programs.
  const bool draws = std::ranges::any_of(
      outputs_, [](const std::string& file) { return file.ends_with(".png") || file.ends_with(".pdf"); });
  if (draws && status == RunStatus::done && unhashed_.find("barriers") == nullptr)
    unhashed_.set("machine", machine_facts_of_pictures());
  if (recorded_outputs_.is_null() || (status != RunStatus::done && status != RunStatus::failed)) return;
  unhashed_ = without(unhashed_, mending_member);
}

bool RunDirectory::finish(RunStatus status, std::string_view given_reason,
                          std::chrono::milliseconds patience) {
  if (finished_.exchange(true)) return false;
  std::exception_ptr first;
  std::string reason(given_reason);
  const auto ends_well = [&] { return status == RunStatus::done || status == RunStatus::shard; };
  // A failure turns done into failed; throws the first.
  const auto attempt = [&](const std::function<void()>& step) {
    try {
      step();
    } catch (const std::exception& problem) {
      if (!first) first = std::current_exception();
      if (!ends_well()) return;
      status = RunStatus::failed;
      reason = problem.what();
    }
  };
  const std::unique_lock lock = lock_within(mutex_, patience);
  attempt([&] { require_place(); });
  const bool records = kind_ == Kind::directory && !later_ && lock.owns_lock() && !first;
  // Without it, notebooks and manifest may be half changed.
  if (lock.owns_lock())
    for (const auto& notebook : notebooks_) attempt([&] { notebook->save(patience); });
  Json files = Json::List();
  if (records)
    attempt([&] {
      // A killed run has no time for large files.
      files = outputs(status != RunStatus::killed);
      if (!ends_well()) return;
      require_recorded(files);
      require_present();
    });
  attempt([&] {
    Json fields = Json::object({{"status", name(status)}});
    if (!reason.empty()) fields.set("reason", reason);
    journal_->close("end", fields, patience);
  });
  if (records) {
    if (status == RunStatus::done && !scratch_) attempt([&] { require_own_files(); });
    // Comparisons trust the manifest: files first.
    const auto durable = [&] {
      return !scratch_ && (ends_well() || status == RunStatus::failed) ? Durable::yes : Durable::no;
    };
    if (durable() == Durable::yes) {
      attempt([&] {
        if (!journal_->is_lost()) wait_for_disk(journal_->path());
      });
      attempt([&] { wait_for_outputs(files); });
      if (before_end_) attempt(before_end_);
    }
    attempt([&] {
      note_end(status, reason, files);
      write_manifest(durable());
      if (durable() == Durable::yes) wait_for_disk(root_);
    });
  }
  if (lock_) lock_->release();
  mended_ = status == RunStatus::done && !recorded_outputs_.is_null();
  if (first) std::rethrow_exception(first);
  return true;
}

}  // namespace asperity
