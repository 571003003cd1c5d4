// SPDX-License-Identifier: GPL-3.0-or-later
// A measured file held in memory while a reader takes it apart. The whole file is read once into
// counted memory, so every later allocation can be bounded by its size and no reader touches the
// disk. Not for files larger than memory.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

class SourceFile {
 public:
  // Throws Error{bad_file} for a path that is missing, a directory, not a plain file, not readable
  // or empty; Error{out_of_memory} when it does not fit.
  SourceFile(std::string path, Monitor& monitor);
  // The same of bytes that did not come from a disk; they are copied. `name` is what errors call it, and
  // its ending counts. Throws Error{bad_file} if there are none.
  SourceFile(std::string name, std::string_view bytes);
  // The same of bytes that are taken over, with the ending that counts: what a packed file holds. Throws
  // Error{bad_file} if there are none.
  SourceFile(std::string name, Array<char> bytes, std::string extension);

  const std::string& path() const { return path_; }
  // The ending of the name in lower case without the dot: "x3p"; empty if there is none.
  const std::string& extension() const { return extension_; }
  std::string_view bytes() const { return {bytes_.data(), bytes_.size()}; }
  // The bytes without a UTF-8 byte-order mark.
  std::string_view text() const;
  // False for bytes that no text holds: a zero byte among the first few thousand.
  bool looks_like_text() const;

 private:
  void refuse_empty() const;
  std::string path_;
  std::string extension_;
  Array<char> bytes_;
};

// The content of a file that may be empty, a pipe or a device: a script, or a file of a run. Throws
// Error{bad_file} where it cannot be opened or read to its end, Error{out_of_memory} as above.
std::string text_of_file(const std::string& path);
// Throws Error{out_of_memory} where a file of so many bytes exceeds the limit of memory, or, without a limit,
// a quarter of the machine's memory.
void require_room_for(const std::string& path, std::uintmax_t bytes);

// Lower-case ending of a path without the dot.
std::string file_extension(const std::string& path);
// "\"path\"", as errors name files.
std::string file_name(const std::string& path);
// Throws Error{bad_file}: the file's name, a blank, `finding`; then the hint.
[[noreturn]] void refuse_file(const SourceFile& file, const std::string& finding,
                              const std::string& hint = {});

}  // namespace asperity
