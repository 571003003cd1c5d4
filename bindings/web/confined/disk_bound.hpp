// SPDX-License-Identifier: GPL-3.0-or-later
// Disk limit of a run. The kernel gives an ordinary user no limit for all files of a folder together. The
// folder is therefore measured often, and a run beyond the limit is ended. Files beyond the limit are then
// removed: most recently changed first, the run's own record last.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace asperity::web {

struct DiskUse {
  std::int64_t bytes = 0;  // on the disk, files and folders
  std::size_t files = 0;   // files and folders
};
// Stops counting beyond `most_files`.
DiskUse disk_use(const std::filesystem::path& folder, std::size_t most_files);

// The time of the next measurement after one from `begun` until now. Measuring takes at most a tenth of the
// time.
std::chrono::steady_clock::time_point next_look(std::chrono::steady_clock::time_point begun);

// Removes files beyond the limits and returns one sentence about them, or "". No process may write to the
// folder meanwhile. Follows no links.
std::string keep_within(const std::filesystem::path& folder, std::int64_t most_bytes, std::size_t most_files);

}  // namespace asperity::web
