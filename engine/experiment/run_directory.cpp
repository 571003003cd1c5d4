// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/experiment/run_directory.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <exception>
#include <functional>
#include <utility>

#include "engine/core/digest.hpp"
#include "engine/core/error.hpp"
#include "engine/core/patient_lock.hpp"
#include "engine/core/text.hpp"
#include "engine/experiment/aside_file.hpp"
#include "engine/experiment/recorded_run.hpp"
#include "engine/experiment/run_facts.hpp"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view script_file = "script.lua";
constexpr std::string_view manifest_file = "manifest.json";
constexpr std::string_view journal_file = "journal.jsonl";
constexpr std::string_view store_folder = "store";
constexpr std::string_view views_folder = ".views";  // what the page draws of a run (bindings/web/views.hpp)
constexpr std::string_view earlier_folder = "before-";

void make_folders(const fs::path& folder) {
  if (folder.empty()) return;
  std::error_code reason;
  fs::create_directories(folder, reason);
  if (reason) throw_file_error("make the folder", folder, reason.value());
}

// The first free runs/<script>-<n>: mkdir decides, so two runs at once never share one.
fs::path numbered_directory(const fs::path& runs, const std::string& script_name) {
  make_folders(runs);
  const std::string stem = safe_file_name(fs::path(script_name).stem().string());
  for (int n = 1;; ++n) {
    fs::path candidate = runs / (stem + "-" + std::to_string(n));
    if (::mkdir(candidate.c_str(), 0777) == 0) return candidate;
    if (errno != EEXIST) throw_file_error("make the folder", candidate, errno);
  }
}

fs::path given_directory(const fs::path& out) {
  std::error_code reason;
  if (fs::exists(out, reason) && !fs::is_directory(out, reason))
    throw Error(ErrorCode::bad_value, "`--out` names " + asperity::quoted(out.string()) + ", which is a file",
                "give the name of a new directory");
  make_folders(out);
  if (!fs::is_empty(out, reason) && !reason)
    throw Error(ErrorCode::bad_value,
                "`--out` names " + asperity::quoted(out.string()) + ", which is not empty",
                "give a new directory");
  if (reason) throw_file_error("read the folder", out, reason.value());
  return out;
}

// Moves what an earlier run left, all but its store, into the first free before-<n>.
void move_aside(const fs::path& root) {
  fs::path earlier;
  std::error_code reason;
  for (int n = 1; earlier.empty() || fs::exists(earlier, reason); ++n)
    earlier = root / (std::string(earlier_folder) + std::to_string(n));
  make_folders(earlier);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(root)) files.push_back(entry.path());
  for (const fs::path& file : files) {
    const std::string name = file.filename().string();
    if (name == store_folder || name.starts_with(earlier_folder)) continue;
    fs::rename(file, earlier / name, reason);
    if (reason) throw_file_error("move aside", file, reason.value());
  }
}

}  // namespace

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

fs::path RunDirectory::made_for(const RunSetup& setup) {
  return setup.out ? given_directory(*setup.out) : numbered_directory(setup.runs, setup.script_name);
}

void RunDirectory::make(const RunSetup& setup) {
  // Absolute, so that a script which changes the working directory moves nothing.
  root_ = fs::absolute(setup.resume ? *setup.resume : made_for(setup)).lexically_normal();
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
  journal_ = again ? Journal::again(root_ / journal_file) : std::make_unique<Journal>(root_ / journal_file);
  if (!again) write_aside(root_ / script_file, setup.script_text);
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
  write_manifest();
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
}

void RunDirectory::write_manifest() {
  Json whole = manifest_;
  whole.set("unhashed", unhashed_);
  write_aside(root_ / manifest_file, whole.text(2) + "\n");
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
  for (const std::string_view own : {script_file, manifest_file, journal_file})
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

bool RunDirectory::finish(RunStatus status, std::string_view reason, std::chrono::milliseconds patience) {
  if (finished_.exchange(true)) return false;
  std::exception_ptr first;
  const auto attempt = [&](const std::function<void()>& step) {
    try {
      step();
    } catch (const std::exception&) {
      if (!first) first = std::current_exception();
    }
  };
  const std::unique_lock lock = lock_within(mutex_, patience);
  // Without the lock the list of notebooks and the manifest may be half changed: what is on disk
  // already then stays as it is.
  if (lock.owns_lock())
    for (const auto& notebook : notebooks_) attempt([&] { notebook->save(patience); });
  attempt([&] {
    Json fields = Json::object({{"status", name(status)}});
    if (!reason.empty()) fields.set("reason", reason);
    journal_->close("end", fields, patience);
  });
  if (kind_ == Kind::directory && !later_ && lock.owns_lock()) {
    attempt([&] {
      if (text_) {
        const std::string text = text_();
        write_aside(root_ / script_file, text);
        const Json* script = manifest_.find("script");
        Json whole = script == nullptr ? Json::object() : *script;
        manifest_.set("script", std::move(whole.set("digest", Digester().add(text).hex())));
      }
      manifest_.set("status", name(status));
      if (!reason.empty()) manifest_.set("reason", reason);
      Json::List inputs;
      for (const Input& input : inputs_)
        inputs.push_back(
            Json::object({{"file", input.file}, {"bytes", input.bytes}, {"digest", input.digest}}));
      manifest_.set("inputs", std::move(inputs));
      // A run that must die now does not read its large files once more.
      manifest_.set("outputs", outputs(status != RunStatus::killed));
      Json::List verdicts;
      for (const Verdict& verdict : expectations_.verdicts()) verdicts.push_back(to_json(verdict));
      manifest_.set("expectations", std::move(verdicts));
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - started_;
      unhashed_.set("finished", utc_now()).set("seconds", seconds.count());
      write_manifest();
    });
  }
  if (first) std::rethrow_exception(first);
  return true;
}

}  // namespace asperity
