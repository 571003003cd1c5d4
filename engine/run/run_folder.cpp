// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/run_folder.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view earlier_folder = "before-";

bool is_earlier_folder(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with(earlier_folder) && name.size() > earlier_folder.size() &&
         name.find_first_not_of("0123456789", earlier_folder.size()) == std::string::npos;
}

bool is_no_part_of_the_record(const fs::path& file) {
  return file.filename() == run_names::store || file.filename() == RunLock::file_name ||
         is_earlier_folder(file);
}

void move_into(const fs::path& file, const fs::path& folder) {
  std::error_code reason;
  fs::rename(file, folder / file.filename(), reason);
  if (reason) throw_file_error("move aside", file, reason.value());
}

// None, or an empty one after a power cut.
bool has_no_manifest(const fs::path& folder) {
  std::error_code missing;
  const fs::path manifest = folder / run_names::manifest;
  if (!fs::exists(fs::symlink_status(manifest, missing))) return true;
  return fs::is_regular_file(fs::symlink_status(manifest, missing)) &&
         fs::file_size(manifest, missing) == 0 && !missing;
}

}  // namespace

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

// mkdir is atomic.
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

// Checked again under the lock: another run may have ended.
fs::path given_directory(const fs::path& out, std::shared_ptr<RunLock>& lock, bool locked,
                         std::vector<fs::path>& holding) {
  std::error_code reason;
  if (fs::exists(out, reason) && !fs::is_directory(out, reason))
    throw Error(ErrorCode::bad_value, "`--out` names " + quoted(out.string()) + ", which is a file",
                "give the name of a new directory");
  holding = make_folders(out);
  const auto require_new = [&] {
    if (!is_not_begun(out))
      throw Error(ErrorCode::bad_value, "`--out` names " + quoted(out.string()) + ", which is not empty",
                  fs::exists(out / run_names::manifest, reason)
                      ? "give a new directory, or --resume to go on with the run there"
                      : "give a new directory");
  };
  if (!locked) {
    require_new();
    return out;
  }
  if (lock == nullptr && !is_not_begun(out)) lock = RunLock::take_if_known(out);  // names the holder
  require_new();
  if (lock == nullptr) lock = RunLock::take(out);
  require_new();
  sweep_parts(out, Parts::all);
  for (const std::string_view own : {run_names::script, run_names::journal, run_names::manifest})
    fs::remove(out / own, reason);
  return out;
}

void wait_for_names_in(const fs::path& folder) {
  if (::access(folder.c_str(), R_OK) == 0) wait_for_disk(folder);
}

std::string text_of_run_file(const fs::path& path) {
  std::error_code missing;
  // Opening a pipe would block.
  if (!fs::is_regular_file(path, missing) || ::access(path.c_str(), R_OK) != 0)
    throw Error(ErrorCode::bad_file, "there is no " + quoted(path.string()) + " that can be read",
                "give the directory of a run, such as runs/quick_start-1");
  return text_of_file(path.string());
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

void move_aside(const fs::path& root) {
  fs::path earlier;
  std::error_code reason;
  for (int n = 1; earlier.empty() || fs::exists(fs::symlink_status(earlier, reason)); ++n)
    earlier = root / (std::string(earlier_folder) + std::to_string(n));
  make_folders(earlier);
  if (fs::exists(root / run_names::manifest, reason)) move_into(root / run_names::manifest, earlier);
  for (const fs::path& file : entries_of(root))
    if (!is_no_part_of_the_record(file)) move_into(file, earlier);
}

bool is_not_begun(const fs::path& folder) {
  std::error_code missing;
  if (!fs::exists(folder, missing)) return true;
  if (!fs::is_directory(folder, missing) || !has_no_manifest(folder)) return false;
  return std::ranges::all_of(entries_of(folder), [](const fs::path& file) {
    std::error_code gone;
    const fs::file_status status = fs::symlink_status(file, gone);
    if (fs::is_directory(status)) return file.filename() == run_names::store || is_earlier_folder(file);
    return fs::is_regular_file(status) &&
           (is_part(file) ||
            std::ranges::find(run_names::files, file.filename().string()) != run_names::files.end());
  });
}

void finish_moving_aside(const fs::path& folder) {
  std::error_code missing;
  if (!fs::is_directory(folder, missing) ||
      fs::exists(fs::symlink_status(folder / run_names::manifest, missing)))
    return;
  const auto number = [](const fs::path& earlier) {
    return std::stoll("0" + earlier.filename().string().substr(earlier_folder.size(), 15));
  };
  fs::path latest;
  const std::vector<fs::path> entries = entries_of(folder);
  for (const fs::path& file : entries)
    if (is_earlier_folder(file) && (latest.empty() || number(latest) < number(file))) latest = file;
  if (latest.empty() || !fs::is_directory(fs::symlink_status(latest, missing)) ||
      !fs::exists(latest / run_names::manifest, missing))
    return;
  // If the name exists there, the file here belongs to the run about to begin.
  for (const fs::path& file : entries)
    if (!is_no_part_of_the_record(file) && !fs::exists(fs::symlink_status(latest / file.filename(), missing)))
      move_into(file, latest);
}

void refuse_links(const fs::path& folder) {
  for (const std::string_view own :
       {run_names::script, run_names::manifest, run_names::journal, run_names::store, run_names::loaded}) {
    std::error_code missing;
    if (fs::is_symlink(fs::symlink_status(folder / own, missing)))
      throw Error(ErrorCode::bad_file, quoted((folder / own).string()) + " is a link",
                  own == run_names::store
                      ? "results in another folder are named by `--store`; take the link away"
                      : "a run writes its own files where they are; take the link away");
  }
}

}  // namespace asperity
