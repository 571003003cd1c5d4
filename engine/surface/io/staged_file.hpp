// SPDX-License-Identifier: GPL-3.0-or-later
// A file that is written aside, under another name in the same directory, and takes its place only
// when it is complete: a reader never sees half of it, and a failed write leaves what was there.
#pragma once

#include <fstream>
#include <string>
#include <string_view>

namespace asperity {

class StagedFile {
 public:
  // Throws Error{bad_file} if the directory does not exist or the path is a directory, a device or a pipe.
  explicit StagedFile(std::string path);
  // Removes what was written aside unless commit() was called.
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  // Where the bytes go before commit(), for writers that open files themselves.
  const std::string& aside() const { return aside_; }
  // Appends bytes. Throws Error{bad_file} when they cannot be written (a full disk).
  void write(std::string_view bytes);
  // Puts the file in its place. Throws Error{bad_file}.
  void commit();

 private:
  std::string path_, aside_;
  std::ofstream stream_;
  bool committed_ = false;
};

}  // namespace asperity
