// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/run_directory.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <system_error>

#include "engine/core/files/disk.hpp"
#include "engine/core/require.hpp"
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
    refuse_bad_file(quoted(root_.string()) + " was moved or removed while the run wrote there",
                    "resume it with --resume at its new place");
}

std::string_view name(RunStatus status) {
  constexpr std::array<std::string_view, 6> names = {"running", "done",        "shard",
                                                     "failed",  "interrupted", "killed"};
  return names.at(static_cast<std::size_t>(status));
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
  // Enough to resume after a power cut.
  write_manifest(durable);
  if (scratch_) return;
  wait_for_disk(root_);
  for (const fs::path& folder : holding_) wait_for_names_in(folder);
}

// Keeps earlier dates.
void RunDirectory::take_up() {
  const Json earlier = read_manifest(root_);
  const Json& kept = earlier["unhashed"];
  Json::List dates;
  if (const Json* known = kept.find("resumed")) dates = known->list();
  if (const Json* started = kept.find("started")) unhashed_.set("started", *started);
  dates.push_back(utc_now());
  unhashed_.set("resumed", std::move(dates));
  // Stays recorded until the mending succeeds.
  recorded_outputs_ =
      earlier["status"] == Json(name(RunStatus::done)) ? earlier["outputs"] : kept[mending_member];
  if (!recorded_outputs_.is_null()) unhashed_.set(mending_member, recorded_outputs_);
  const Json* read = earlier.find("inputs");
  if (read == nullptr) read = kept.find(run_names::inputs_so_far);
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
  // Named by content: names may lead out, files may change.
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
    } catch (const Error&) {  // finish() reports it
    }
  }
  return std::ranges::any_of(
      recorded_inputs_, [&](const auto& known) { return known.first == file && known.second != digest; });
}

void RunDirectory::keep_inside(const fs::path& relative, std::string_view file) const {
  const fs::path base = root_.empty() ? fs::current_path() : root_;
  bool outside = relative.is_absolute() || *relative.begin() == "..";
  if (!outside && !root_.empty()) {
    // A link inside may lead out.
    const fs::path real = fs::weakly_canonical(base / relative);
    const fs::path real_base = fs::weakly_canonical(base);
    // weakly_canonical does not resolve a dangling link.
    const bool dangling = fs::is_symlink(base / relative) && !fs::exists(base / relative);
    outside = dangling || std::ranges::mismatch(real_base, real).in1 != real_base.end();
  }
  if (outside)
    throw Error(ErrorCode::not_permitted, "the file " + quoted(file) + " is outside the run directory",
                "give a path in the run directory, or add `--trust`");
}

fs::path RunDirectory::path_for(std::string_view file) {
  if (later_) {
    RunSetup setup = *later_;
    setup.script_text = text_();
    make(setup);
    later_.reset();
  }
  fs::path given = fs::path(std::string(file)).lexically_normal();
  // Methods return absolute inner paths.
  if (given.is_absolute() && !root_.empty())
    if (const fs::path inside = given.lexically_relative(root_); !inside.empty() && *inside.begin() != "..")
      given = inside;
  if (file.empty() || file.find('\0') != std::string_view::npos || !given.has_filename() ||
      given.filename() == "." || given.filename() == "..")
    refuse(quoted(file) + " is not the name of a file", "give a name such as \"heights.npy\"");
  constexpr std::size_t longest = 255;  // bytes of a name
  for (const fs::path& part : given)
    if (part.native().size() > longest)
      refuse("a file name is " + std::to_string(part.native().size()) + " bytes long",
             "give at most " + std::to_string(longest));
  const bool outside_allowed = trusted_ && (given.is_absolute() || *given.begin() == "..");
  if (!outside_allowed) keep_inside(given, file);
  fs::path place = given.is_absolute() || root_.empty() ? given : root_ / given;
  for (const std::string_view own : run_names::files)
    if (!root_.empty() && place.lexically_normal() == root_ / own)
      throw Error(ErrorCode::not_permitted, "the file " + quoted(own) + " belongs to the run itself",
                  "choose another name");
  for (const std::string_view folder : {run_names::store, run_names::views, run_names::loaded}) {
    const fs::path own = root_ / folder;
    if (!root_.empty() && std::ranges::mismatch(own, place.lexically_normal()).in1 == own.end())
      throw Error(
          ErrorCode::not_permitted,
          "the folder " + quoted(folder) + " belongs to the run itself, and the file is " + quoted(file),
          "choose another name");
  }
  if (kind_ == Kind::dry) return place;
  std::error_code ignored;
  if (fs::is_directory(place, ignored)) refuse(quoted(file) + " is a folder", "give the name of a file");
  require_place();
  make_folders(place.parent_path());
  const std::lock_guard lock(mutex_);
  if (outputs_.insert(given.string()).second) unseen_.insert(given.string());
  some_unseen_ = !unseen_.empty();
  return place;
}

void RunDirectory::see_outputs() {
  if (!some_unseen_) return;
  const std::lock_guard lock(mutex_);
  std::error_code missing;
  std::erase_if(unseen_, [&](const std::string& file) { return fs::exists(root_ / file, missing); });
  some_unseen_ = !unseen_.empty();
}

void RunDirectory::forget_output(const fs::path& place) {
  const std::lock_guard lock(mutex_);
  const std::string own = own_name(place);
  outputs_.erase(own.empty() ? place.string() : own);
  unseen_.erase(own.empty() ? place.string() : own);
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

std::vector<std::string> RunDirectory::written() const {
  const std::lock_guard lock(mutex_);
  return {outputs_.begin(), outputs_.end()};
}

RunDirectory::Findings RunDirectory::set_aside() {
  Findings findings;
  findings.verdicts = expectations_.exchange({});
  const std::lock_guard lock(mutex_);
  findings.notebooks = std::exchange(notebooks_, {});
  journal_->write("again", Json::object());
  return findings;
}

void RunDirectory::put_back(Findings findings) {
  expectations_.exchange(std::move(findings.verdicts));
  std::vector<std::shared_ptr<Notebook>> made;
  {
    const std::lock_guard lock(mutex_);
    made = std::exchange(notebooks_, std::move(findings.notebooks));
  }
  for (const auto& notebook : made) {
    std::error_code gone;
    if (notebook->csv().empty()) continue;
    fs::remove(notebook->csv(), gone);
    forget_output(notebook->csv());
  }
  for (const auto& notebook : notebooks_) notebook->write_again();
}

Verdict RunDirectory::expect(const Expectation& expectation, const Table& table, std::string_view name) {
  Verdict verdict = evaluate(expectation, table, name);
  expectations_.add(verdict);
  journal_->write("expect", to_json(verdict));
  return verdict;
}

std::shared_ptr<Notebook> RunDirectory::notebook(std::string_view name) {
  if (name.empty()) refuse("a notebook has an empty name", "give it a name");
  const auto find = [&]() -> std::shared_ptr<Notebook> {
    for (const auto& notebook : notebooks_)
      if (notebook->name() == name) return notebook;
    return nullptr;
  };
  std::string file = safe_file_name(name);
  {
    const std::lock_guard lock(mutex_);
    if (auto known = find()) return known;
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

}  // namespace asperity
