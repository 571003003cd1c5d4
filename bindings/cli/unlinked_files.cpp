// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/cli/unlinked_files.hpp"

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>

namespace asperity::cli {

namespace {

constexpr auto between_looks = std::chrono::milliseconds(50);

template <class Action>
void each_unlinked_file(const Action& action) {
  rlimit handles{};
  if (::getrlimit(RLIMIT_NOFILE, &handles) != 0) return;
  const int end = static_cast<int>(std::min<rlim_t>(handles.rlim_cur, 4096));
  for (int descriptor = STDERR_FILENO + 1; descriptor < end; ++descriptor) {
    struct stat facts {};
    if (::fstat(descriptor, &facts) == 0 && S_ISREG(facts.st_mode) && facts.st_nlink == 0)
      action(descriptor, std::int64_t{facts.st_blocks} * 512);
  }
}

}  // namespace

std::int64_t unlinked_bytes() {
  std::int64_t bytes = 0;
  each_unlinked_file([&](int, std::int64_t taken) { bytes += taken; });
  return bytes;
}

void empty_unlinked_files() {
  each_unlinked_file([](int descriptor, std::int64_t) {
    // Fails for a read-only descriptor; its file has a writable descriptor or no longer grows.
    if (::ftruncate(descriptor, 0) != 0) errno = 0;
  });
}

UnlinkedFilesBound::UnlinkedFilesBound(std::int64_t most_bytes)
    : thread_([this, most_bytes] {
        while (!over_.load()) {
          if (unlinked_bytes() > most_bytes) empty_unlinked_files();
          std::this_thread::sleep_for(between_looks);
        }
      }) {}

UnlinkedFilesBound::~UnlinkedFilesBound() {
  over_.store(true);
  thread_.join();
}

}  // namespace asperity::cli
