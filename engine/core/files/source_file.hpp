// SPDX-License-Identifier: GPL-3.0-or-later
// A measured file, read once into counted memory, so that readers never access the disk and the file size
// bounds all allocations. Not for files larger than memory.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

class SourceFile {
 public:
  // Throws Error{bad_file} if missing, unreadable, empty or no plain file, Error{out_of_memory} if too large.
  SourceFile(std::string path, Monitor& monitor);
  // Copies bytes; `name` serves errors and the extension. Throws Error{bad_file} if empty.
  SourceFile(std::string name, std::string_view bytes);
  // Takes over bytes, for example of an archive. Throws Error{bad_file} if empty.
  SourceFile(std::string name, Array<char> bytes, std::string extension);

  const std::string& path() const { return path_; }
  // Lower case, without the dot: "x3p"; may be empty.
  const std::string& extension() const { return extension_; }
  std::string_view bytes() const { return {bytes_.data(), bytes_.size()}; }
  // Without a UTF-8 byte-order mark.
  std::string_view text() const;
  // False for a zero among the first few thousand bytes.
  bool looks_like_text() const;

 private:
  void refuse_empty() const;
  std::string path_;
  std::string extension_;
  Array<char> bytes_;
};

// Content of a script or run file, which may be empty, a pipe or a device. Throws Error{bad_file},
// Error{out_of_memory}.
std::string text_of_file(const std::string& path);
// Throws Error{out_of_memory} beyond the memory limit or, without a limit, a quarter of the machine's memory.
void require_room_for(const std::string& path, std::uintmax_t bytes);

// Lower case, without the dot.
std::string file_extension(const std::string& path);
// "\"path\"".
std::string file_name(const std::string& path);
// Throws Error{bad_file}: file name, a blank, `finding`; then the hint.
[[noreturn]] void refuse_file(const SourceFile& file, const std::string& finding,
                              const std::string& hint = {});

}  // namespace asperity
