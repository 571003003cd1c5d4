// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/files/aside_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <system_error>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/files/part_file.hpp"
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
              "cannot " + std::string(action) + " " + asperity::quoted(path.string()) + ": " + text,
              advice(reason));
}

AsideFile::AsideFile(std::filesystem::path target) : target_(std::move(target)) {
  std::error_code ignored;
  if (std::filesystem::is_other(target_, ignored))
    throw Error(ErrorCode::bad_file,
                "cannot write " + asperity::quoted(target_.string()) + ": it is a device or a pipe",
                "give the name of a file");
  temporary_ = part_beside(target_);
}

AsideFile::~AsideFile() {
  if (!committed_) ::unlink(temporary_.c_str());
}

void AsideFile::commit() {
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) throw_file_error("write", target_, errno);
  committed_ = true;
}

void write_aside(const std::filesystem::path& target, std::string_view content, Durable durable) {
  AsideFile aside(target);
  const int descriptor =
      ::open(aside.temporary().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor < 0) throw_file_error("write", target, errno);
  int reason = write_all(descriptor, content);
  if (reason == 0 && durable == Durable::yes && ::fsync(descriptor) != 0 && errno != EINVAL) reason = errno;
  if (::close(descriptor) != 0 && reason == 0) reason = errno;
  if (reason != 0) throw_file_error("write", target, reason);
  aside.commit();
}

void append_whole(int descriptor, std::string_view content, const std::filesystem::path& path) {
  const off_t before = ::lseek(descriptor, 0, SEEK_END);
  const int reason = write_all(descriptor, content);
  if (reason == 0) return;
  // Nothing better can be done if cutting back fails as well; the reason given is the first one.
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
  append_whole(file.descriptor, content, path);
  return true;
}

std::string safe_file_name(std::string_view text) {
  constexpr std::size_t longest = 120;
  std::string name;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool kept = std::isalnum(byte) || c == '_' || c == '.' || byte >= 0x80;
    if (kept) {
      name += c;
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  if (name.size() > longest) {
    name.resize(longest);
    // Not in the middle of a character.
    while (!name.empty() && (static_cast<unsigned char>(name.back()) & 0xC0) == 0x80) name.pop_back();
    if (!name.empty() && static_cast<unsigned char>(name.back()) >= 0xC0) name.pop_back();
  }
  while (!name.empty() && name.back() == '-') name.pop_back();
  const std::size_t first = name.find_first_not_of(".-");
  name.erase(0, first == std::string::npos ? name.size() : first);
  return name.empty() ? "unnamed" : name;
}

}  // namespace asperity
