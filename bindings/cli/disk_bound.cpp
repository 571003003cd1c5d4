// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/cli/disk_bound.hpp"

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <tuple>
#include <vector>

#include "engine/core/text.hpp"
#include "engine/run/run_folder.hpp"

namespace asperity::cli {

namespace {

namespace fs = std::filesystem;

struct Written {
  fs::path path;
  bool folder = false, record = false;
  std::int64_t bytes = 0, changed = 0;  // on disk; nanoseconds since 1970
};

// On the disk, at least the file size.
std::int64_t taken_bytes(const struct stat& facts) {
  return std::max<std::int64_t>(facts.st_size, std::int64_t{facts.st_blocks} * 512);
}

template <class Action>
void each_entry(const fs::path& folder, const Action& action) {
  std::error_code problem;
  for (fs::recursive_directory_iterator at(folder, fs::directory_options::none, problem), end;
       !problem && at != end; at.increment(problem)) {
    struct stat facts {};
    if (::lstat(at->path().c_str(), &facts) == 0 && !action(at->path(), facts)) return;
  }
}

bool is_record(const fs::path& folder, const fs::path& path) {
  return path.parent_path() == folder &&
         std::ranges::find(run_names::files, path.filename().string()) != run_names::files.end();
}

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

DiskUse disk_use(const fs::path& folder, std::size_t most_files) {
  DiskUse use;
  each_entry(folder, [&](const fs::path&, const struct stat& facts) {
    use.bytes += taken_bytes(facts);
    return ++use.files <= most_files;
  });
  return use;
}

std::chrono::steady_clock::time_point next_look(std::chrono::steady_clock::time_point begun) {
  const auto now = std::chrono::steady_clock::now();
  return now +
         std::max<std::chrono::steady_clock::duration>(std::chrono::milliseconds(40), 9 * (now - begun));
}

std::string keep_within(const fs::path& folder, std::int64_t most_bytes, std::size_t most_files) {
  const DiskUse use = disk_use(folder, most_files);
  if (use.bytes <= most_bytes && use.files <= most_files) return "";
  std::vector<Written> all;
  DiskUse left;
  each_entry(folder, [&](const fs::path& path, const struct stat& facts) {
    const std::int64_t changed = std::int64_t{facts.st_mtim.tv_sec} * 1'000'000'000 + facts.st_mtim.tv_nsec;
    all.push_back({path, S_ISDIR(facts.st_mode), is_record(folder, path), taken_bytes(facts), changed});
    left.bytes += all.back().bytes;
    ++left.files;
    return true;
  });
  // Files, then folders, deepest first. Only empty folders are removed.
  std::ranges::sort(all, [](const Written& one, const Written& other) {
    const auto order = [](const Written& of) {
      return std::tuple(of.record, of.folder,
                        of.folder ? -static_cast<std::int64_t>(of.path.native().size()) : -of.changed);
    };
    return order(one) < order(other);
  });
  std::size_t removed = 0;
  for (const Written& one : all) {
    if (left.bytes <= most_bytes && left.files <= most_files) break;
    std::error_code problem;
    if (!fs::remove(one.path, problem) || problem) continue;
    ++removed;
    left.bytes -= one.bytes;
    --left.files;
  }
  return removed == 0
             ? ""
             : std::to_string(removed) + " of its files, the last ones written, were removed: the limit is " +
                   format_bytes(most_bytes) + " in " + std::to_string(most_files) + " files";
}

std::int64_t unlinked_bytes() {
  std::int64_t bytes = 0;
  each_unlinked_file([&](int, std::int64_t taken) { bytes += taken; });
  return bytes;
}

void empty_unlinked_files() {
  each_unlinked_file([](int descriptor, std::int64_t) {
    // Fails for a read-only descriptor; its file is open elsewhere or no longer grows.
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
