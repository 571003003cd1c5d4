// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/confined/disk_bound.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <system_error>
#include <tuple>
#include <vector>

#include "engine/core/text.hpp"
#include "engine/run/run_folder.hpp"

namespace asperity::web {

namespace {

namespace fs = std::filesystem;

struct Written {
  fs::path path;
  bool folder = false, record = false;
  std::int64_t bytes = 0, changed = 0;  // on the disk; nanoseconds since 1970
};

// On the disk, at least the file size.
std::int64_t taken_bytes(const struct stat& facts) {
  return std::max<std::int64_t>(facts.st_size, std::int64_t{facts.st_blocks} * 512);
}

std::int64_t changed_at(const struct stat& facts) {
  return std::int64_t{facts.st_mtim.tv_sec} * 1'000'000'000 + facts.st_mtim.tv_nsec;
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
    all.push_back(
        {path, S_ISDIR(facts.st_mode), is_record(folder, path), taken_bytes(facts), changed_at(facts)});
    left.bytes += all.back().bytes;
    ++left.files;
    return true;
  });
  // Files, then folders with the deepest first. Only empty folders are removed.
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
  return removed == 0 ? ""
                      : std::to_string(removed) +
                            " of its files, the last that were written, were removed, because there may be " +
                            format_bytes(most_bytes) + " in " + std::to_string(most_files) + " files";
}

}  // namespace asperity::web
