// SPDX-License-Identifier: GPL-3.0-or-later
// A folder for files of a moment, removed with its content at the end. Its name tells the writer, as the
// names of parts do (atomic_file.hpp). The first folder of a process removes those that killed writers have
// left.
#pragma once

#include <filesystem>
#include <string_view>

namespace asperity {

class TemporaryFolder {
 public:
  // In `parent`, or among the temporary files of the system. Throws Error{bad_file}.
  explicit TemporaryFolder(std::string_view purpose, const std::filesystem::path& parent = {});
  ~TemporaryFolder() { remove(); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  // For a process that ends without destructors.
  void remove() const;

 private:
  std::filesystem::path path_;
};

}  // namespace asperity
