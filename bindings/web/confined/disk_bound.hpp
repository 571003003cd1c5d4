// SPDX-License-Identifier: GPL-3.0-or-later
// What the files of a run may take on the disk. The kernel offers an ordinary user no limit on all files of a
// folder together, so it is looked at often, a run that went beyond is ended, and what it left beyond is
// removed: the files that were changed last go first, and those in which the run itself keeps its record
// last.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace asperity::web {

struct DiskUse {
  std::int64_t bytes = 0;  // on the disk, of files and folders together
  std::size_t files = 0;   // and folders
};
// Stops counting where there are more than `most_files`.
DiskUse disk_use(const std::filesystem::path& folder, std::size_t most_files);

// When to look again after a look that began at `begun` and ends now: soon, and never so often that looking
// takes more than a tenth of the time.
std::chrono::steady_clock::time_point next_look(std::chrono::steady_clock::time_point begun);

// Removes what is beyond. No process may be writing there. Follows no link. Returns what was removed, in a
// sentence, or "".
std::string keep_within(const std::filesystem::path& folder, std::int64_t most_bytes, std::size_t most_files);

}  // namespace asperity::web
