// SPDX-License-Identifier: GPL-3.0-or-later
// A temporary folder, removed with its content by the destructor. Its name contains the writer
// (atomic_file.hpp); each new folder removes folders of killed writers from the same parent.
#pragma once

#include <filesystem>
#include <string_view>

namespace asperity {

class TemporaryFolder {
 public:
  // Default `parent`: the system's temporary folder. Throws Error{bad_file}.
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
