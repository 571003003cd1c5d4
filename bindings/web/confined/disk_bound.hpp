// SPDX-License-Identifier: GPL-3.0-or-later
// Disk limit of a run. The kernel has no limit for a folder as a whole, so that the folder is measured often.
// A run beyond the limit is ended, and files beyond the limit are removed: last changed first, the run's
// record last.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace asperity::web {

struct DiskUse {
  std::int64_t bytes = 0;  // on the disk
  std::size_t files = 0;   // files and folders
};
// Stops counting beyond `most_files`.
DiskUse disk_use(const std::filesystem::path& folder, std::size_t most_files);

// Time of the next measurement after one since `begun`; at most a tenth of the time is spent measuring.
std::chrono::steady_clock::time_point next_look(std::chrono::steady_clock::time_point begun);

// Removes files beyond the limits; returns a sentence about them, or "". No process may write there. Follows
// no links.
std::string keep_within(const std::filesystem::path& folder, std::int64_t most_bytes, std::size_t most_files);

}  // namespace asperity::web
