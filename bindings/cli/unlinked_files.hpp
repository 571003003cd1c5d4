// SPDX-License-Identifier: GPL-3.0-or-later
// Files that a script has open and removed: they take space on the disk until they are closed, and nobody who
// looks at its directory sees them. A script of somebody else's (`--limit-disk`, runs of the page) is watched
// for them from inside its process, where alone they can be seen; what it holds so beyond its limit is
// emptied. Nothing that the run would leave is lost by that.
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>

namespace asperity::cli {

// Bytes on the disk of the regular files without a name that this process has open.
std::int64_t unlinked_bytes();
// Empties those that are open for writing.
void empty_unlinked_files();

// Looks some twenty times a second, from its construction to its end.
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
