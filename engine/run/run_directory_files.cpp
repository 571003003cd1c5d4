// SPDX-License-Identifier: GPL-3.0-or-later
// The files of a script: permitted names, notebooks and inputs.
#include <algorithm>
#include <system_error>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity {

namespace fs = std::filesystem;

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
  // Methods return absolute paths inside.
  if (given.is_absolute() && !root_.empty())
    if (const fs::path inside = given.lexically_relative(root_); !inside.empty() && *inside.begin() != "..")
      given = inside;
  if (file.empty() || file.find('\0') != std::string_view::npos || !given.has_filename() ||
      given.filename() == "." || given.filename() == "..")
    throw Error(ErrorCode::bad_value, quoted(file) + " is not the name of a file",
                "give a name such as \"heights.npy\"");
  constexpr std::size_t longest = 255;  // bytes of a name on Linux file systems
  for (const fs::path& part : given)
    if (part.native().size() > longest)
      throw Error(ErrorCode::bad_value,
                  "a file name is " + std::to_string(part.native().size()) + " bytes long",
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
  if (fs::is_directory(place, ignored))
    throw Error(ErrorCode::bad_value, quoted(file) + " is a folder", "give the name of a file");
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
    // Two names may give one file name.
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
