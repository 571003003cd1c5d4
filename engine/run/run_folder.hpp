// SPDX-License-Identifier: GPL-3.0-or-later
// The folder of a run before and after the run: names of its files, the search for a new folder, the test
// whether a run may begin there, and the moving aside of an earlier run.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/run/run_lock.hpp"

namespace asperity {

// Files written by the run itself, at the top of its directory.
namespace run_names {
inline constexpr std::string_view script = "script.lua";
inline constexpr std::string_view manifest = "manifest.json";
inline constexpr std::string_view journal = "journal.jsonl";
inline constexpr std::string_view store = "store";  // a folder: results of heavy calls (result_files.hpp)
inline constexpr std::string_view views =
    ".views";  // a folder: drawings of the page (bindings/web/api/views.hpp)
// A folder: copies of the files that `require`, `dofile` and `loadfile` read.
inline constexpr std::string_view loaded = "script_files";
// A member of the manifest during the run: its inputs so far.
inline constexpr std::string_view inputs_so_far = "inputs_so_far";
inline constexpr std::array<std::string_view, 4> files = {script, manifest, journal, RunLock::file_name};
}  // namespace run_names

// Makes the missing folders of a path. Returns the folders that got a new name in them. Throws
// Error{bad_file}.
std::vector<std::filesystem::path> make_folders(const std::filesystem::path& folder);

// Makes the first free runs/<script>-<n>; two runs at once never share one. `holding` becomes the folders in
// which one was made.
std::filesystem::path numbered_directory(const std::filesystem::path& runs, const std::string& script_name,
                                         std::vector<std::filesystem::path>& holding);

// Makes the folder named by `--out`, or uses an existing folder if a run may begin there. With `locked`, it
// locks the folder and removes the files of a run killed before its first manifest. Throws Error{bad_value}
// if the folder holds more, Error{bad_state} if another process has its lock.
std::filesystem::path given_directory(const std::filesystem::path& out, std::shared_ptr<RunLock>& lock,
                                      bool locked, std::vector<std::filesystem::path>& holding);

// Waits until the disk has the names in a folder; does not wait for a folder without permission to read.
void wait_for_names_in(const std::filesystem::path& folder);

// The content of one of the run's own files. Throws Error{bad_file} if the file is missing or cannot be read
// to its end.
std::string text_of_run_file(const std::filesystem::path& path);

// Sorted paths of the entries of a folder. Throws Error{bad_file}.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder);

// Moves the files of an earlier run, except its store, into the first free before-<n>. The manifest is moved
// first: if it is missing, the moving was interrupted (finish_moving_aside).
void move_aside(const std::filesystem::path& root);

// Whether a run may begin in a directory: it is missing, empty, or holds only files written before the first
// manifest of a run.
bool is_not_begun(const std::filesystem::path& folder);
// Finishes an interrupted moving aside of an earlier run (RunSetup::anew): its remaining files follow the
// manifest into before-<n>. Otherwise it does nothing.
void finish_moving_aside(const std::filesystem::path& folder);
// Throws Error{bad_file} if script, manifest, journal or store of a run, or its folder of script files, is a
// link.
void refuse_links(const std::filesystem::path& folder);

}  // namespace asperity
