// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/files/disk.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <random>
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
  refuse_bad_file("cannot " + std::string(action) + " " + quoted(path.string()) + ": " + text,
                  advice(reason));
}

ScopedFile::~ScopedFile() {
  if (number >= 0) ::close(number);
}

std::string random_name() {
  std::random_device device;
  const std::uint64_t bits = (std::uint64_t{device()} << 32) | device();
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(bits));
  return digits.data();
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
  if (before >= 0 && ::ftruncate(descriptor, before) != 0) errno = 0;
  throw_file_error("write", path, reason);
}

bool append_to_existing(const std::filesystem::path& path, std::string_view content) {
  const ScopedFile file(::open(path.c_str(), O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC));
  if (file.number < 0 && (errno == ENOENT || errno == ELOOP)) return false;
  if (file.number < 0) throw_file_error("write", path, errno);
  struct ::stat facts {};
  if (::fstat(file.number, &facts) == 0 && facts.st_nlink > 1) return false;
  append_whole(file.number, content, path);
  return true;
}

void wait_for_disk(const std::filesystem::path& file_or_folder) {
  const ScopedFile file(::open(file_or_folder.c_str(), O_RDONLY | O_CLOEXEC));
  // Some network file systems cannot sync a folder.
  if (file.number >= 0 && (::fsync(file.number) == 0 || errno == EINVAL)) return;
  const int reason = errno;
  refuse_bad_file("cannot save " + quoted(file_or_folder.string()) +
                      " on the disk: " + std::generic_category().message(reason),
                  "check the disk");
}

}  // namespace asperity
