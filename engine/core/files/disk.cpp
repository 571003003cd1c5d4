// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/files/disk.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t taken = ::write(descriptor, bytes.data(), bytes.size());
    if (taken < 0 && errno == EINTR) continue;
    if (taken <= 0) return taken < 0 ? errno : EIO;
    bytes.remove_prefix(static_cast<std::size_t>(taken));
  }
  return 0;
}

void wait_for_disk(const std::filesystem::path& file_or_folder) {
  const int descriptor = ::open(file_or_folder.c_str(), O_RDONLY | O_CLOEXEC);
  int reason = descriptor < 0 ? errno : 0;
  if (descriptor >= 0 && ::fsync(descriptor) != 0) reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  // Some file systems over a network have no such call for a folder.
  if (reason == 0 || reason == EINVAL) return;
  throw Error(ErrorCode::bad_file,
              "cannot bring " + asperity::quoted(file_or_folder.string()) +
                  " to the disk: " + std::generic_category().message(reason),
              "check the disk");
}

}  // namespace asperity
