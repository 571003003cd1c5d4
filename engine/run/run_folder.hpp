// SPDX-License-Identifier: GPL-3.0-or-later
// The folder of a run before and beside the run: what is in it by which name, how a new one is found and
// made, whether one is free to begin in, and how what an earlier run left is moved aside.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/run/run_lock.hpp"

namespace asperity {

// What a run writes by itself, at the top of its directory.
namespace run_names {
inline constexpr std::string_view script = "script.lua";
inline constexpr std::string_view manifest = "manifest.json";
inline constexpr std::string_view journal = "journal.jsonl";
inline constexpr std::string_view store = "store";  // a folder: results of heavy calls (result_files.hpp)
inline constexpr std::string_view views =
    ".views";  // one: what the page draws of a run (bindings/web/api/views.hpp)
// A folder: copies of the files that `require`, `dofile` and `loadfile` read.
inline constexpr std::string_view loaded = "script_files";
// A member of the manifest while the run goes on: its inputs so far.
inline constexpr std::string_view inputs_so_far = "inputs_so_far";
inline constexpr std::array<std::string_view, 4> files = {script, manifest, journal, RunLock::file_name};
}  // namespace run_names

// Makes what is missing of a path of folders. Returns the folders that got a new name in them. Throws
// Error{bad_file}.
std::vector<std::filesystem::path> make_folders(const std::filesystem::path& folder);

// Makes the first free runs/<script>-<n>; two runs at once never share one. `holding` becomes the folders in
// which one was made.
std::filesystem::path numbered_directory(const std::filesystem::path& runs, const std::string& script_name,
                                         std::vector<std::filesystem::path>& holding);

// Makes the folder that `--out` names, or takes it as it is where a run may begin there; what a run left that
// died before its first manifest is taken away. Locked unless it is not to be, in which case nothing is taken
// away. Throws Error{bad_value} where it holds more, Error{bad_state} where another process has its lock.
std::filesystem::path given_directory(const std::filesystem::path& out, std::shared_ptr<RunLock>& lock,
                                      bool locked, std::vector<std::filesystem::path>& holding);

// Until the disk has the names in a folder; one that may be entered but not read cannot be waited for.
void wait_for_names_in(const std::filesystem::path& folder);

// The content of a file that a run wrote by itself. Throws Error{bad_file} where there is none, or it cannot
// be read to its end.
std::string text_of_run_file(const std::filesystem::path& path);

// What a folder holds, by name. Throws Error{bad_file}.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder);

// Moves what an earlier run left, all but its store, into the first free before-<n>: the manifest first, so
// that a run which is cut off in this is known by its lack (finish_moving_aside).
void move_aside(const std::filesystem::path& root);

// Whether a directory, which may be missing, holds nothing of a run but what one writes before its first
// manifest, or nothing at all: a run may begin there.
bool is_not_begun(const std::filesystem::path& folder);
// Goes on with the moving aside of an earlier run (RunSetup::anew) that was cut off: what is left of it
// follows its manifest into before-<n>. Nothing is done where that is not how things stand.
void finish_moving_aside(const std::filesystem::path& folder);
// Throws Error{bad_file} where script, manifest, journal or store of a run is a link.
void refuse_links(const std::filesystem::path& folder);

}  // namespace asperity
