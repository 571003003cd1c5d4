// SPDX-License-Identifier: GPL-3.0-or-later
// The folder of a run: names, new folders, whether a run may begin, earlier runs moved aside.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/run/run_lock.hpp"

namespace asperity {

// At the top of the directory.
namespace run_names {
inline constexpr std::string_view script = "script.lua";
inline constexpr std::string_view manifest = "manifest.json";
inline constexpr std::string_view journal = "journal.jsonl";
inline constexpr std::string_view store = "store";  // a folder: results of heavy calls (result_files.hpp)
inline constexpr std::string_view views =
    ".views";  // a folder: drawings of the page (bindings/web/confined/views.hpp)
// Copies of the files loaded by `require`, `dofile` and `loadfile`.
inline constexpr std::string_view loaded = "script_files";
// In the manifest during the run.
inline constexpr std::string_view inputs_so_far = "inputs_so_far";
inline constexpr std::array<std::string_view, 4> files = {script, manifest, journal, RunLock::file_name};
}  // namespace run_names

// Returns the parents of new folders. Throws Error{bad_file}.
std::vector<std::filesystem::path> make_folders(const std::filesystem::path& folder);

// Makes the first free runs/<script>-<n>, never shared by two runs. `holding`: as make_folders().
std::filesystem::path numbered_directory(const std::filesystem::path& runs, const std::string& script_name,
                                         std::vector<std::filesystem::path>& holding);

// Makes the folder of `--out`, or accepts one where a run may begin. `locked`: locks it and removes a run
// killed before its first manifest. Throws Error{bad_value} if it holds more, Error{bad_state} if it is
// locked.
std::filesystem::path given_directory(const std::filesystem::path& out, std::shared_ptr<RunLock>& lock,
                                      bool locked, std::vector<std::filesystem::path>& holding);

// Syncs the names in a readable folder to the disk.
void wait_for_names_in(const std::filesystem::path& folder);

// Throws Error{bad_file}.
std::string text_of_run_file(const std::filesystem::path& path);

// Sorted paths. Throws Error{bad_file}.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder);

// Moves an earlier run, except its store, into the first free before-<n>, the manifest first, so an
// interrupted move is recognised (finish_moving_aside).
void move_aside(const std::filesystem::path& root);

// Whether the folder is missing, empty, or has only files from before a first manifest.
bool is_not_begun(const std::filesystem::path& folder);
// Finishes an interrupted move_aside(), if any.
void finish_moving_aside(const std::filesystem::path& folder);
// Throws Error{bad_file} if an own file or folder of a run is a link.
void refuse_links(const std::filesystem::path& folder);

}  // namespace asperity
