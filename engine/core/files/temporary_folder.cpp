// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/files/temporary_folder.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <vector>

#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/disk.hpp"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view lead = "asperity-";

// Only folders of this user; does not follow links.
void sweep(const fs::path& parent) {
  std::error_code problem;
  std::vector<fs::path> left;
  for (fs::directory_iterator entry(parent, problem), end; !problem && entry != end;
       entry.increment(problem)) {
    struct ::stat facts {};
    if (entry->path().filename().native().starts_with("." + std::string(lead)) &&
        ::lstat(entry->path().c_str(), &facts) == 0 && S_ISDIR(facts.st_mode) &&
        facts.st_uid == ::geteuid() && is_abandoned(entry->path()))
      left.push_back(entry->path());
  }
  for (const fs::path& folder : left) fs::remove_all(folder, problem);
}

}  // namespace

TemporaryFolder::TemporaryFolder(std::string_view purpose, const fs::path& parent) {
  std::error_code ignored;
  fs::path base = parent.empty() ? fs::temp_directory_path(ignored) : parent;
  if (base.empty()) base = "/tmp";
  sweep(base);
  path_ = part_beside(base / (std::string(lead) + std::string(purpose)));
  if (::mkdir(path_.c_str(), 0700) != 0) throw_file_error("make a temporary folder in", base, errno);
}

void TemporaryFolder::remove() const {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace asperity
