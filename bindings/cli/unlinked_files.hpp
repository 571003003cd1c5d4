// SPDX-License-Identifier: GPL-3.0-or-later
// Open files that a script has deleted. Such files use disk space until closed, but are invisible in the
// directory. With `--limit-disk` and in page runs, a thread inside the confined process therefore watches
// them and empties them beyond the limit. This loses no file that the run would leave.
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>

namespace asperity::cli {

// Bytes on the disk of open regular files without a name.
std::int64_t unlinked_bytes();
// Empties the files that are open for writing.
void empty_unlinked_files();

// Checks about twenty times a second during its lifetime.
class UnlinkedFilesBound {
 public:
  explicit UnlinkedFilesBound(std::int64_t most_bytes);
  ~UnlinkedFilesBound();
  UnlinkedFilesBound(const UnlinkedFilesBound&) = delete;
  UnlinkedFilesBound& operator=(const UnlinkedFilesBound&) = delete;

 private:
  std::atomic<bool> over_{false};
  std::thread thread_;
};

}  // namespace asperity::cli
