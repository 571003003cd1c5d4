// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/files/disk.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <string>
#include <system_error>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

std::string advice(int reason) {
  switch (reason) {
    case ENOSPC:
      return "free some space on that disk, or write elsewhere with `--out`";
    case EDQUOT:
      return "your quota on that disk is used up; write elsewhere with `--out`";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a place you may write to with `--out`";
    default:
      return {};
  }
}

}  // namespace

void throw_file_error(std::string_view action, const std::filesystem::path& path, int reason) {
  std::string text = std::generic_category().message(reason);
  if (!text.empty()) text.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(text.front())));
  throw Error(ErrorCode::bad_file,
              "cannot " + std::string(action) + " " + quoted(path.string()) + ": " + text, advice(reason));
}

int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t taken = ::write(descriptor, bytes.data(), bytes.size());
    if (taken < 0 && errno == EINTR) continue;
    if (taken <= 0) return taken < 0 ? errno : EIO;
    bytes.remove_prefix(static_cast<std::size_t>(taken));
  }
  return 0;
}

void append_whole(int descriptor, std::string_view content, const std::filesystem::path& path) {
  const off_t before = ::lseek(descriptor, 0, SEEK_END);
  const int reason = write_all(descriptor, content);
  if (reason == 0) return;
  // If the truncation also fails, report the first reason.
  if (before >= 0 && ::ftruncate(descriptor, before) != 0) errno = 0;
  throw_file_error("write", path, reason);
}

bool append_to_existing(const std::filesystem::path& path, std::string_view content) {
  struct Open {
    int descriptor;
    ~Open() {
      if (descriptor >= 0) ::close(descriptor);
    }
  };
  const Open file{::open(path.c_str(), O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC)};
  if (file.descriptor < 0 && (errno == ENOENT || errno == ELOOP)) return false;
  if (file.descriptor < 0) throw_file_error("write", path, errno);
  struct ::stat facts {};
  if (::fstat(file.descriptor, &facts) == 0 && facts.st_nlink > 1) return false;
  append_whole(file.descriptor, content, path);
  return true;
}

void wait_for_disk(const std::filesystem::path& file_or_folder) {
  const int descriptor = ::open(file_or_folder.c_str(), O_RDONLY | O_CLOEXEC);
  int reason = descriptor < 0 ? errno : 0;
  if (descriptor >= 0 && ::fsync(descriptor) != 0) reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  // Some network file systems cannot sync a folder.
  if (reason == 0 || reason == EINVAL) return;
  throw Error(ErrorCode::bad_file,
              "cannot bring " + quoted(file_or_folder.string()) +
                  " to the disk: " + std::generic_category().message(reason),
              "check the disk");
}

}  // namespace asperity
