// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/run_directory.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <exception>
#include <functional>
#include <utility>

#include "engine/core/digest.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/patient_lock.hpp"
#include "engine/core/text.hpp"
#include "engine/run/recorded_run.hpp"
#include "engine/run/run_facts.hpp"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view script_file = "script.lua";
constexpr std::string_view manifest_file = "manifest.json";
constexpr std::string_view journal_file = "journal.jsonl";
constexpr std::string_view store_folder = "store";
constexpr std::string_view views_folder =
    ".views";  // what the page draws of a run (bindings/web/api/views.hpp)
constexpr std::string_view earlier_folder = "before-";

constexpr std::string_view mending = "recorded_outputs";  // of the manifest, until a run is mended

// Makes what is missing of a path of folders. Returns the folders that got a new name in them.
std::vector<fs::path> make_folders(const fs::path& folder) {
  if (folder.empty()) return {};
  std::vector<fs::path> holding;
  std::error_code reason;
  for (fs::path part = fs::absolute(folder).lexically_normal();
       part.has_relative_path() && !fs::exists(part, reason); part = part.parent_path())
    holding.push_back(part.parent_path());
  fs::create_directories(folder, reason);
  if (reason) throw_file_error("make the folder", folder, reason.value());
  return holding;
}

// The first free runs/<script>-<n>: mkdir decides, so two runs at once never share one.
fs::path numbered_directory(const fs::path& runs, const std::string& script_name,
                            std::vector<fs::path>& holding) {
  holding = make_folders(runs);
  holding.push_back(fs::absolute(runs).lexically_normal());
  const std::string stem = safe_file_name(fs::path(script_name).stem().string());
  for (int n = 1;; ++n) {
    fs::path candidate = runs / (stem + "-" + std::to_string(n));
    if (::mkdir(candidate.c_str(), 0777) == 0) return candidate;
    if (errno != EEXIST) throw_file_error("make the folder", candidate, errno);
  }
}

// A folder that `--out` may name; locked, and looked at again then, for another run may have come and gone.
// What a run left that died before its first manifest is taken away.
fs::path given_directory(const fs::path& out, std::shared_ptr<RunLock>& lock, bool locked,
                         std::vector<fs::path>& holding) {
  std::error_code reason;
  if (fs::exists(out, reason) && !fs::is_directory(out, reason))
    throw Error(ErrorCode::bad_value, "`--out` names " + asperity::quoted(out.string()) + ", which is a file",
                "give the name of a new directory");
  holding = make_folders(out);
  const auto require_new = [&] {
    if (!is_not_begun(out))
      throw Error(ErrorCode::bad_value,
                  "`--out` names " + asperity::quoted(out.string()) + ", which is not empty",
                  "give a new directory");
  };
  if (!locked) {
    require_new();
    return out;
  }
  if (lock == nullptr && !is_not_begun(out)) lock = RunLock::take_if_known(out);  // who is there is named
  require_new();
  if (lock == nullptr) lock = RunLock::take(out);
  require_new();
  sweep_parts(out, Parts::all);
  for (const std::string_view own : {script_file, journal_file, manifest_file}) fs::remove(out / own, reason);
  return out;
}

// One that may be entered but not read cannot be waited for.
void wait_for_names_in(const fs::path& folder) {
  if (::access(folder.c_str(), R_OK) == 0) wait_for_disk(folder);
}

bool is_earlier_folder(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with(earlier_folder) && name.size() > earlier_folder.size() &&
         name.find_first_not_of("0123456789", earlier_folder.size()) == std::string::npos;
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code reason;
  for (fs::directory_iterator entry(folder, reason), end; !reason && entry != end; entry.increment(reason))
    entries.push_back(entry->path());
  if (reason) throw_file_error("read the folder", folder, reason.value());
  std::ranges::sort(entries);
  return entries;
}

// Stays where it is when a run is moved aside.
bool is_no_part_of_the_record(const fs::path& file) {
  return file.filename() == store_folder || file.filename() == RunLock::file_name || is_earlier_folder(file);
}

void move_into(const fs::path& file, const fs::path& folder) {
  std::error_code reason;
  fs::rename(file, folder / file.filename(), reason);
  if (reason) throw_file_error("move aside", file, reason.value());
}

// Moves what an earlier run left, all but its store, into the first free before-<n>: the manifest first, so
// that a run which is cut off in this is known by its lack (finish_moving_aside).
void move_aside(const fs::path& root) {
  fs::path earlier;
  std::error_code reason;
  for (int n = 1; earlier.empty() || fs::exists(fs::symlink_status(earlier, reason)); ++n)
    earlier = root / (std::string(earlier_folder) + std::to_string(n));
  make_folders(earlier);
  if (fs::exists(root / manifest_file, reason)) move_into(root / manifest_file, earlier);
  for (const fs::path& file : entries_of(root))
    if (!is_no_part_of_the_record(file)) move_into(file, earlier);
}

// No manifest, or one of which a power cut left nothing.
bool has_no_manifest(const fs::path& folder) {
  std::error_code missing;
  const fs::path manifest = folder / manifest_file;
  if (!fs::exists(fs::symlink_status(manifest, missing))) return true;
  return fs::is_regular_file(fs::symlink_status(manifest, missing)) &&
         fs::file_size(manifest, missing) == 0 && !missing;
}

}  // namespace

bool is_not_begun(const fs::path& folder) {
  std::error_code missing;
  if (!fs::exists(folder, missing)) return true;
  if (!fs::is_directory(folder, missing) || !has_no_manifest(folder)) return false;
  return std::ranges::all_of(entries_of(folder), [](const fs::path& file) {
    std::error_code gone;
    const fs::file_status status = fs::symlink_status(file, gone);
    if (fs::is_directory(status)) return file.filename() == store_folder || is_earlier_folder(file);
    return fs::is_regular_file(status) &&
           (is_part(file) || file.filename() == script_file || file.filename() == journal_file ||
            file.filename() == manifest_file || file.filename() == RunLock::file_name);
  });
}

void finish_moving_aside(const fs::path& folder) {
  std::error_code missing;
  if (!fs::is_directory(folder, missing) || fs::exists(fs::symlink_status(folder / manifest_file, missing)))
    return;
  const auto number = [](const fs::path& earlier) {
    return std::stoll("0" + earlier.filename().string().substr(earlier_folder.size(), 15));
  };
  fs::path latest;
  const std::vector<fs::path> entries = entries_of(folder);
  for (const fs::path& file : entries)
    if (is_earlier_folder(file) && (latest.empty() || number(latest) < number(file))) latest = file;
  if (latest.empty() || !fs::is_directory(fs::symlink_status(latest, missing)) ||
      !fs::exists(latest / manifest_file, missing))
    return;
  // A file that is there already is of the run that was to begin then.
  for (const fs::path& file : entries)
    if (!is_no_part_of_the_record(file) && !fs::exists(fs::symlink_status(latest / file.filename(), missing)))
      move_into(file, latest);
}

void refuse_links(const fs::path& folder) {
  for (const std::string_view own : {script_file, manifest_file, journal_file, store_folder}) {
    std::error_code missing;
    if (fs::is_symlink(fs::symlink_status(folder / own, missing)))
      throw Error(ErrorCode::bad_file, asperity::quoted((folder / own).string()) + " is a link",
                  own == store_folder ? "results in another folder are named by `--store`; take the link away"
                                      : "a run writes its own files where they are; take the link away");
  }
}

std::string_view name(RunStatus status) {
  switch (status) {
    case RunStatus::running:
      return "running";
    case RunStatus::done:
      return "done";
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
    const bool is_run = is_not_begun(prepared.path) || fs::exists(prepared.path / manifest_file, reason);
    if (is_run && ::access(prepared.path.c_str(), W_OK) == 0) prepared.lock = RunLock::take(prepared.path);
  } else if (setup.out) {
    prepared.made = !fs::exists(*setup.out, reason);
    prepared.path = given_directory(*setup.out, prepared.lock, true, holding);
  } else {
    prepared.made = true;
    prepared.path = numbered_directory(setup.runs, setup.script_name, holding);
    prepared.lock = RunLock::take(prepared.path);
  }
  // The other process may be shut off from the folders above.
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
  // Absolute, so that a script which changes the working directory moves nothing.
  root_ = fs::absolute(setup.resume ? *setup.resume
                       : setup.out  ? given_directory(*setup.out, lock_, !scratch_, holding_)
                                    : numbered_directory(setup.runs, setup.script_name, holding_))
              .lexically_normal();
  if (lock_ == nullptr && !scratch_) lock_ = RunLock::take(root_);
  if (setup.resume) {
    refuse_links(root_);
    // Of writers that were killed: nobody else writes here now.
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
  return {root_ / script_file, root_ / manifest_file, root_};
}

void RunDirectory::begin(const RunSetup& setup) {
  const bool again = setup.resume && !setup.anew;
  const Durable durable = scratch_ ? Durable::no : Durable::yes;
  if (again && setup.journal_lost) {
    std::error_code missing;
    fs::remove(root_ / journal_file, missing);
  }
  journal_ = again && !setup.journal_lost ? Journal::again(root_ / journal_file)
                                          : std::make_unique<Journal>(root_ / journal_file);
  if (!again) write_atomically(root_ / script_file, setup.script_text, durable);
  const std::string digest = Digester().add(setup.script_text).hex();
  const std::string script = fs::path(setup.script_name).filename().string();
  manifest_.set("status", name(RunStatus::running))
      .set("versions", setup.versions)
      .set("script", Json::object({{"name", script}, {"digest", digest}}))
      .set("arguments", Json::strings(setup.arguments))
      .set("seed", setup.seed)
      .set("trusted", setup.trusted);
  if (!setup.barriers.is_null()) {
    manifest_.set("confined", true);
    unhashed_.set("barriers", setup.barriers);
  }
  unhashed_.set("started", utc_now())
      .set("directory", root_.string())
      .set("script_path", setup.script_name)
      .set("threads", setup.threads)
      .set("machine", machine_facts());
  if (again) take_up();
  journal_->write("begin", Json::object({{"script", script}, {"digest", digest}, {"seed", setup.seed}}));
  // What it takes to go on after a power cut, whatever becomes of the rest.
  write_manifest(durable);
  if (scratch_) return;
  wait_for_disk(root_);
  for (const fs::path& folder : holding_) wait_for_names_in(folder);
}

// Dates of the run so far come along.
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
  // What a finished run is to be again is kept until it is, though the mending itself be cut off.
  const Json* status = earlier.find("status");
  if (status != nullptr && *status == Json(name(RunStatus::done))) {
    if (const Json* outputs = earlier.find("outputs")) recorded_outputs_ = *outputs;
  } else if (kept != nullptr) {
    if (const Json* outputs = kept->find(mending)) recorded_outputs_ = *outputs;
  }
  if (!recorded_outputs_.is_null()) unhashed_.set(mending, recorded_outputs_);
}

void RunDirectory::write_manifest(Durable durable) {
  Json whole = manifest_;
  whole.set("unhashed", unhashed_);
  write_atomically(root_ / manifest_file, whole.text(2) + "\n", durable);
}

// Their content, and their names in every folder up to the run's own.
void RunDirectory::wait_for_outputs(const Json& outputs) const {
  std::set<fs::path> folders = {root_};
  for (const Json& entry : outputs.list()) {
    const fs::path place = (root_ / entry.find("file")->string()).lexically_normal();
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

// Which outputs are not what was recorded of a run that is mended, as a sentence; "" where all are.
std::string RunDirectory::unlike_recorded(const Json& outputs) const {
  if (recorded_outputs_.is_null()) return {};
  std::vector<std::string> unlike;
  const auto file_of = [](const Json& entry) { return entry.find("file")->string(); };
  for (const Json& entry : recorded_outputs_.list()) {
    const Json::List& now = outputs.list();
    const auto found =
        std::ranges::find_if(now, [&](const Json& other) { return file_of(other) == file_of(entry); });
    if (found == now.end() || !(*found == entry)) unlike.push_back(quoted(file_of(entry)));
  }
  if (unlike.empty()) return {};
  return joined(unlike, " and ") + " could not be made again as recorded";
}

void RunDirectory::keep_inside(const fs::path& relative, std::string_view file) const {
  const fs::path base = root_.empty() ? fs::current_path() : root_;
  bool outside = relative.is_absolute() || *relative.begin() == "..";
  if (!outside && !root_.empty()) {
    // A link that stands inside may still lead out.
    const fs::path real = fs::weakly_canonical(base / relative);
    const fs::path real_base = fs::weakly_canonical(base);
    // One that leads to nothing yet is not resolved above, and would be followed by whoever creates it.
    const bool dangling = fs::is_symlink(base / relative) && !fs::exists(base / relative);
    outside = dangling || std::ranges::mismatch(real_base, real).in1 != real_base.end();
  }
  if (outside)
    throw Error(ErrorCode::not_permitted, "the file " + quoted(file) + " lies outside the run directory",
                "files are written only under the run directory; `--trust` lifts this");
}

fs::path RunDirectory::path_for(std::string_view file) {
  if (later_) {
    RunSetup setup = *later_;
    setup.script_text = text_();
    make(setup);
    later_.reset();
  }
  fs::path given = fs::path(std::string(file)).lexically_normal();
  // What a method returned as the place of a file may be given back: it is inside, though absolute.
  if (given.is_absolute() && !root_.empty())
    if (const fs::path inside = given.lexically_relative(root_); !inside.empty() && *inside.begin() != "..")
      given = inside;
  if (file.empty() || file.find('\0') != std::string_view::npos || !given.has_filename() ||
      given.filename() == "." || given.filename() == "..")
    throw Error(ErrorCode::bad_value, quoted(file) + " is not the name of a file",
                "give a name such as \"heights.npy\"");
  constexpr std::size_t longest = 255;  // bytes of one name on the file systems of Linux
  for (const fs::path& part : given)
    if (part.native().size() > longest)
      throw Error(ErrorCode::bad_value,
                  "a file name is " + std::to_string(part.native().size()) + " bytes long",
                  "give at most " + std::to_string(longest));
  const bool outside_allowed = trusted_ && (given.is_absolute() || *given.begin() == "..");
  if (!outside_allowed) keep_inside(given, file);
  fs::path place = given.is_absolute() || root_.empty() ? given : root_ / given;
  for (const std::string_view own :
       {script_file, manifest_file, journal_file, std::string_view(RunLock::file_name)})
    if (!root_.empty() && place.lexically_normal() == root_ / own)
      throw Error(ErrorCode::not_permitted, "the file " + quoted(own) + " belongs to the run itself",
                  "choose another name");
  for (const std::string_view folder : {store_folder, views_folder}) {
    const fs::path own = root_ / folder;
    if (!root_.empty() && std::ranges::mismatch(own, place.lexically_normal()).in1 == own.end())
      throw Error(
          ErrorCode::not_permitted,
          "the folder " + quoted(folder) + " belongs to the run itself, and the file is " + quoted(file),
          "choose another name");
  }
  if (kind_ == Kind::dry) return place;
  std::error_code ignored;
  if (fs::is_directory(place, ignored))
    throw Error(ErrorCode::bad_value, quoted(file) + " is a folder", "give the name of a file");
  make_folders(place.parent_path());
  const std::lock_guard lock(mutex_);
  outputs_.insert(given.string());
  return place;
}

fs::path RunDirectory::place_to_read(std::string_view file) const {
  const fs::path given{std::string(file)};
  std::error_code ignored;
  if (given.is_absolute() || root_.empty()) return given;
  const fs::path in_run = (root_ / given).lexically_normal();
  const auto is_given = [name = given.lexically_normal()](const std::string& output) {
    return fs::path(output).lexically_normal() == name;
  };
  const std::lock_guard lock(mutex_);
  const bool written = std::ranges::any_of(outputs_, is_given) && fs::exists(in_run, ignored);
  if (!written && fs::exists(given, ignored)) return given;
  return fs::exists(in_run, ignored) ? in_run : given;
}

std::shared_ptr<Notebook> RunDirectory::notebook(std::string_view name) {
  if (name.empty()) throw Error(ErrorCode::bad_value, "a notebook has an empty name", "give it a name");
  const auto find = [&]() -> std::shared_ptr<Notebook> {
    for (const auto& notebook : notebooks_)
      if (notebook->name() == name) return notebook;
    return nullptr;
  };
  std::string file = safe_file_name(name);
  {
    const std::lock_guard lock(mutex_);
    if (auto known = find()) return known;
    // Two names may become one file name; the later one gets a number.
    const std::string stem = file;
    const auto taken = [&] {
      return std::ranges::any_of(notebooks_, [&](const auto& n) { return n->csv().stem() == file; });
    };
    for (int n = 2; taken(); ++n) file = stem + "-" + std::to_string(n);
  }
  const fs::path csv = dry() ? fs::path() : path_for(file + ".csv");
  const std::lock_guard lock(mutex_);
  if (auto known = find()) return known;
  notebooks_.push_back(std::make_shared<Notebook>(std::string(name), csv, *journal_, expectations_));
  return notebooks_.back();
}

void RunDirectory::note(std::string_view key, Json value) {
  const std::lock_guard lock(mutex_);
  manifest_.set(key, std::move(value));
}

void RunDirectory::note_unhashed(std::string_view key, Json value) {
  const std::lock_guard lock(mutex_);
  unhashed_.set(key, std::move(value));
}

void RunDirectory::note_input(std::string_view file, std::int64_t bytes, std::string_view digest) {
  const std::lock_guard lock(mutex_);
  inputs_.insert({std::string(file), bytes, std::string(digest)});
}

Json RunDirectory::outputs(bool with_digests) const {
  Json::List list;
  for (const std::string& file : outputs_) {
    const fs::path place = root_ / file;  // an absolute `file` replaces the root
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
    write_atomically(root_ / script_file, text, Durable::yes);
    const Json* script = manifest_.find("script");
    Json whole = script == nullptr ? Json::object() : *script;
    manifest_.set("script", std::move(whole.set("digest", Digester().add(text).hex())));
  }
  manifest_.set("status", name(status));
  if (!reason.empty()) manifest_.set("reason", reason);
  Json::List inputs;
  for (const Input& input : inputs_)
    inputs.push_back(Json::object({{"file", input.file}, {"bytes", input.bytes}, {"digest", input.digest}}));
  manifest_.set("inputs", std::move(inputs)).set("outputs", std::move(files));
  if (status != RunStatus::killed && !journal_->is_lost())
    if (const std::optional<JournalFacts> facts = journal_->facts())
      manifest_.set("journal", Json::object({{"lines", facts->lines}, {"digest", facts->digest}}));
  Json::List verdicts;
  for (const Verdict& verdict : expectations_.verdicts()) verdicts.push_back(to_json(verdict));
  manifest_.set("expectations", std::move(verdicts));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - started_;
  unhashed_.set("finished", utc_now()).set("seconds", seconds.count());
  if (recorded_outputs_.is_null() || (status != RunStatus::done && status != RunStatus::failed)) return;
  Json::Members kept;
  for (const Json::Member& member : unhashed_.members())
    if (member.first != mending) kept.push_back(member);
  unhashed_ = Json::object(std::move(kept));
}

bool RunDirectory::finish(RunStatus status, std::string_view given_reason,
                          std::chrono::milliseconds patience) {
  if (finished_.exchange(true)) return false;
  std::exception_ptr first;
  std::string reason(given_reason);
  // What goes wrong now is the end of a run that would be done; the first failure is told.
  const auto attempt = [&](const std::function<void()>& step) {
    try {
      step();
    } catch (const std::exception& problem) {
      if (!first) first = std::current_exception();
      if (status != RunStatus::done) return;
      status = RunStatus::failed;
      reason = problem.what();
    }
  };
  const std::unique_lock lock = lock_within(mutex_, patience);
  const bool records = kind_ == Kind::directory && !later_ && lock.owns_lock();
  // Without the lock the list of notebooks and the manifest may be half changed: what is on disk
  // already then stays as it is.
  if (lock.owns_lock())
    for (const auto& notebook : notebooks_) attempt([&] { notebook->save(patience); });
  Json files = Json::List();
  if (records)
    attempt([&] {
      // A run that must die now does not read its large files once more.
      files = outputs(status != RunStatus::killed);
      if (status != RunStatus::done) return;
      if (const std::string unlike = unlike_recorded(files); !unlike.empty())
        throw Error(ErrorCode::bad_state, unlike,
                    "the script does not do the same again, or what it reads has changed");
      if (journal_->is_lost())
        throw Error(ErrorCode::bad_file,
                    quoted(journal_->path().string()) + " was taken away while the run wrote it",
                    "its results are kept: take the run up with --resume");
    });
  attempt([&] {
    Json fields = Json::object({{"status", name(status)}});
    if (!reason.empty()) fields.set("reason", reason);
    journal_->close("end", fields, patience);
  });
  if (records) {
    // What comes to its own end is compared later by what the manifest says, and so is on the disk before it.
    const auto durable = [&] {
      return !scratch_ && (status == RunStatus::done || status == RunStatus::failed) ? Durable::yes
                                                                                     : Durable::no;
    };
    if (durable() == Durable::yes) {
      attempt([&] {
        if (!journal_->is_lost()) wait_for_disk(journal_->path());
      });
      attempt([&] { wait_for_outputs(files); });
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
