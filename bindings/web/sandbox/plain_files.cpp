// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/sandbox/plain_files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

#include "bindings/web/sandbox/frames.hpp"

namespace asperity::web {

namespace {
namespace fs = std::filesystem;
}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

void Descriptor::reset() {
  const int reason = errno;
  if (number_ >= 0) ::close(std::exchange(number_, -1));
  errno = reason;
}

std::optional<OpenFile> open_plain_file(const fs::path& folder, std::string_view name) {
  if (name.empty() || name.size() > 1000 || name.find('\0') != std::string_view::npos) return {};
  Descriptor at(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  while (at.get() >= 0) {
    const std::size_t slash = name.find('/');
    const std::string part(name.substr(0, slash));
    const bool last = slash == std::string_view::npos;
    const bool good = !part.empty() && part != "." && part != "..";
    // Do not block on a pipe.
    const int how = last ? O_RDONLY | O_NONBLOCK | O_NOCTTY : O_PATH | O_DIRECTORY;
    at = Descriptor(good ? ::openat(at.get(), part.c_str(), how | O_NOFOLLOW | O_CLOEXEC) : -1);
    if (last) break;
    name.remove_prefix(slash + 1);
  }
  struct stat facts {};
  if (at.get() < 0 || ::fstat(at.get(), &facts) != 0 || !S_ISREG(facts.st_mode)) return {};
  return OpenFile{std::move(at), facts.st_size};
}

std::optional<std::string> read_plain_file(const fs::path& folder, std::string_view name,
                                           std::size_t most_bytes) {
  const auto open = open_plain_file(folder, name);
  if (!open || open->bytes < 0 || static_cast<std::size_t>(open->bytes) > most_bytes) return {};
  std::string content(static_cast<std::size_t>(open->bytes), '\0');
  if (!read_whole(open->file.get(), content.data(), content.size())) return {};
  return content;
}

std::vector<PlainFile> plain_files(const fs::path& folder, std::size_t most_files, std::int64_t& bytes) {
  std::vector<PlainFile> files;
  bytes = 0;
  std::error_code problem;
  std::size_t seen = 0;
  for (fs::recursive_directory_iterator at(folder, fs::directory_options::none, problem), end;
       !problem && at != end; at.increment(problem)) {
    struct stat facts {};
    if (++seen > most_files) {
      bytes = too_many;
      break;
    }
    if (::lstat(at->path().c_str(), &facts) != 0) continue;
    // On the disk, at least the file size.
    bytes += std::max<std::int64_t>(facts.st_size, facts.st_blocks * 512);
    if (!S_ISREG(facts.st_mode)) continue;
    files.push_back({at->path().lexically_relative(folder).string(), facts.st_size,
                     facts.st_mtim.tv_sec * 1'000'000'000 + facts.st_mtim.tv_nsec});
  }
  return files;
}

std::string media_type(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 21> types{{
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".json", "application/json"},
      {".jsonl", "application/x-ndjson"},
      {".map", "application/json"},
      {".xml", "application/xml"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".ico", "image/x-icon"},
      {".woff2", "font/woff2"},
      {".wasm", "application/wasm"},
      {".webmanifest", "application/manifest+json"},
      {".csv", "text/csv; charset=utf-8"},
      {".txt", "text/plain; charset=utf-8"},
      {".md", "text/plain; charset=utf-8"},
      {".lua", "text/plain; charset=utf-8"},
      {".h5", "application/x-hdf5"},
      {".npy", "application/octet-stream"},
      {".obj", "text/plain; charset=utf-8"},
      {".xyz", "text/plain; charset=utf-8"},
  }};
  for (const auto& [ending, type] : types)
    if (name.ends_with(ending)) return std::string(type);
  return "application/octet-stream";
}

}  // namespace asperity::web
